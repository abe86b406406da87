// lockstep-coordinator: the command line.
#include <CLI/CLI.hpp>

#include "services/coordinator/coordinator_service.hpp"

int main(int argc, char** argv) {
    CLI::App app{
        "Runs a machine's coordinator: takes commands and programs from clients, plans them, and sends frames to "
        "the axes, until SIGTERM or SIGINT. One owns the machine; a second one ends, or stands by."};
    lockstep::CoordinatorServiceOptions options;
    bool no_lcm = false;
    app.add_option("--machine", options.machine_file, "the machine's configuration file")->required();
    app.add_option("--log", options.log_file, "where log lines go; standard error where it is not given");
    app.add_flag("--standby", options.standby,
                 "stand by while another coordinator owns the machine, and take over, at rest, when it falls silent; "
                 "give it to both of two");
    app.add_flag("--second", options.second,
                 "where security is on: join by the keys of `standby`, not of `coordinator`; give it to one of two");
    app.add_flag("--no-lcm", no_lcm, "do not publish the record; a log of its own is kept all the same");
    app.footer(
        "Examples:\n  lockstep-coordinator --machine machine.textproto\n"
        "  lockstep-coordinator --machine machine.textproto --standby\n"
        "SIGUSR1: writes what it heard, decided and said in its last seconds to an incident file\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) { return app.exit(error) == 0 ? 0 : lockstep::kServiceBadInput; }
    options.record = !no_lcm;
    return lockstep::serve_coordinator(options);
}
