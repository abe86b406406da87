// lockstep-coordinator: the command line.
#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "services/coordinator/coordinator_service.hpp"

namespace {

const std::map<std::string, lockstep::OnTakeover> kOnTakeover{{"stop", lockstep::OnTakeover::Stop},
                                                              {"continue", lockstep::OnTakeover::Continue}};

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Runs a machine's coordinator: takes commands and programs from clients, plans them, and sends frames to "
        "the axes, until SIGTERM or SIGINT. One coordinator owns the machine. A second one ends, or stands by with "
        "--standby."};
    lockstep::CoordinatorServiceOptions options;
    bool no_lcm = false;
    app.add_option("--machine", options.machine_file, "the machine's configuration file")->required();
    app.add_option("--log", options.log_file, "the file for log lines; default: standard error");
    CLI::Option* standby = app.add_flag(
        "--standby", options.standby,
        "stand by while another coordinator owns the machine, and take over, with the axes at rest, when it "
        "falls silent; give this option to both coordinators");
    app.add_option("--on-takeover", options.on_takeover,
                   "with --standby: stop a program that is in motion at the takeover; or continue it, "
                   "if every axis rests where the last owner's frames end")
        ->transform(CLI::CheckedTransformer(kOnTakeover).description("{stop,continue}"))
        ->needs(standby)
        ->default_str("stop");
    app.add_flag("--second", options.second,
                 "with security: join with the keys of `standby`, not of `coordinator`; give this option to one of the "
                 "two coordinators");
    app.add_option("--program-limit-mb", options.program_limit_mb,
                   "the largest size of a program's file on this host's disk; in a larger program, blocks that have "
                   "run are dropped")
        ->check(CLI::Range(16, 1'000'000))
        ->capture_default_str();
    app.add_flag("--no-lcm", no_lcm, "do not publish the record; the process still writes its own log");
    app.footer(
        "Examples:\n  lockstep-coordinator --machine machine.textproto\n"
        "  lockstep-coordinator --machine machine.textproto --standby --on-takeover continue\n"
        "SIGUSR1: writes what it received, decided and published in its last seconds to an incident file\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) { return app.exit(error) == 0 ? 0 : lockstep::kServiceBadInput; }
    options.record = !no_lcm;
    return lockstep::serve_coordinator(options);
}
