// lockstep-axis: the command line.
#include "services/arguments/argument_parser.hpp"
#include "services/axis/axis_service.hpp"

int main(int argc, char** argv) {
    lockstep::ArgumentParser parser(
        "Runs one axis of a machine: takes frames from the coordinator, drives the axis's device, publishes its "
        "state and the record of its steps, until SIGTERM or SIGINT.");
    lockstep::AxisServiceOptions options;
    bool no_lcm = false;
    parser.add_option("--machine", options.machine_file, "the machine's configuration file").required();
    parser.add_option("--axis", options.axis,
                      "the axis's name in that file; default: the axis that the file places on this host");
    parser.add_option(
        "--fpga", options.fpga,
        "the device to use instead of the file's: sim (in this process), shm:NAME (of lockstep-fpga) or uio:PATH "
        "(memory-mapped, such as uio:/dev/uio0) or board:NAME/N (of lockstep-board)");
    parser.add_option("--log", options.log_file, "the file for log lines; default: standard error");
    std::string clock_error;
    parser.add_option("--clock-error", clock_error,
                      "for tests: adds errors to the clock of this process and of its simulated device: "
                      "offset=SECONDS,ppm=N,step=SECONDS@SECONDS (after the start); needs time_source: NETWORK");
    parser.add_flag("--no-lcm", no_lcm, "do not publish the record; the process still writes its own log");
    parser.footer(
        "Example: lockstep-axis --machine machine.textproto --axis X\n"
        "SIGUSR1: writes what it received, decided and published in its last seconds to an incident file\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration");
    parser.action([&] {
        options.record = !no_lcm;
        const auto error = lockstep::parse_clock_error(clock_error);
        if (!error) { return lockstep::end_with_bad_input("--clock-error: " + error.error()); }
        options.clock_error = *error;
        return lockstep::serve_axis(options);
    });
    return parser.run(argc, argv);
}
