// lockstep-fpga: the command line.
#include <CLI/CLI.hpp>

#include "services/fpga/fpga_service.hpp"

int main(int argc, char** argv) {
    CLI::App app{"Runs the simulated device of one axis in real time, on shared memory, until SIGTERM or SIGINT."};
    lockstep::FpgaOptions options;
    app.add_option("--machine", options.machine_file, "the machine's configuration file")->required();
    app.add_option("--axis", options.axis, "the axis's name in that file")->required();
    auto* place = app.add_option_group("where", "where the registers are: in shared memory or in a file");
    place->add_option("--name", options.name,
                      "use shared memory of this name, under /dev/shm; the axis's device is then shm:NAME");
    place->add_option("--file", options.file,
                      "map this file, and create it if it is missing; the axis's device is then uio:PATH");
    place->require_option(1);
    app.footer(
        "Examples:\n  lockstep-fpga --machine machine.textproto --axis X --name lockstep-x\n"
        "  lockstep-fpga --machine machine.textproto --axis X --file /run/lockstep/x.registers\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) { return app.exit(error) == 0 ? 0 : 2; }
    return lockstep::serve_fpga(options);
}
