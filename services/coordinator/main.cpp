// lockstep-coordinator: the command line.
#include <string>

#include "services/arguments/argument_parser.hpp"
#include "services/coordinator/coordinator_service.hpp"

int main(int argc, char** argv) {
    lockstep::ArgumentParser parser(
        "Runs a machine's coordinator: takes commands and programs from clients, plans them, and sends frames to "
        "the axes, until SIGTERM or SIGINT. One coordinator owns the machine. A second one ends, or stands by with "
        "--standby.");
    lockstep::CoordinatorServiceOptions options;
    std::string on_takeover = "stop";
    bool no_lcm = false;
    parser.add_option("--machine", options.machine_file, "the machine's configuration file").required();
    parser.add_option("--log", options.log_file, "the file for log lines; default: standard error");
    const lockstep::Argument standby = parser.add_flag(
        "--standby", options.standby,
        "stand by while another coordinator owns the machine, and take over, with the axes at rest, when it "
        "falls silent; give this option to both coordinators");
    parser
        .add_option("--on-takeover", on_takeover,
                    "with --standby: stop a program that is in motion at the takeover; or continue it, "
                    "if every axis rests where the last owner's frames end")
        .one_of({"stop", "continue"})
        .needs(standby)
        .with_default();
    parser.add_flag(
        "--second", options.second,
        "with security: join with the keys of `standby`, not of `coordinator`; give this option to one of the "
        "two coordinators");
    parser
        .add_option("--program-limit-mb", options.program_limit_mb,
                    "the largest size of a program's file on this host's disk; in a larger program, blocks that have "
                    "run are dropped")
        .in_range(16, 1'000'000)
        .with_default();
    parser.add_flag("--no-lcm", no_lcm, "do not publish the record; the process still writes its own log");
    parser.footer(
        "Examples:\n  lockstep-coordinator --machine machine.textproto\n"
        "  lockstep-coordinator --machine machine.textproto --standby --on-takeover continue\n"
        "SIGUSR1: writes what it received, decided and published in its last seconds to an incident file\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration");
    parser.action([&] {
        options.record = !no_lcm;
        options.on_takeover = on_takeover == "continue" ? lockstep::OnTakeover::Continue : lockstep::OnTakeover::Stop;
        return lockstep::serve_coordinator(options);
    });
    return parser.run(argc, argv);
}
