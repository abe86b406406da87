// The command line of a process that serves a device.
#include "services/arguments/argument_parser.hpp"
#include "services/fpga/fpga_service.hpp"

namespace lockstep {

int run_fpga_command(int argc, char** argv, const char* summary, MakeDevice make) {
    ArgumentParser parser(summary);
    FpgaOptions options;
    parser.add_option("--machine", options.machine_file, "the machine's configuration file").required();
    parser.add_option("--axis", options.axis, "the axis's name in that file").required();
    const Verb place = parser.add_choice("where", "where the registers are: in shared memory or in a file");
    place.add_option("--name", options.name,
                     "use shared memory of this name, under /dev/shm; the axis's device is then shm:NAME");
    place.add_option("--file", options.file,
                     "map this file, and create it if it is missing; the axis's device is then uio:PATH");
    parser.add_option("--closed-inputs", options.closed_inputs,
                      "a file with the names of the inputs of the machine that are closed; write it to press or open "
                      "them");
    parser.add_option("--pushes", options.pushes,
                      "a file with lines of a motor's name and by how many mm a hand has pushed its slide so far");
    parser.footer(
        "Examples:\n  lockstep-fpga --machine machine.textproto --axis X --name lockstep-x\n"
        "  lockstep-fpga --machine machine.textproto --axis X --file /run/lockstep/x.registers\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage");
    parser.action([&] { return serve_fpga(options, make); });
    return parser.run(argc, argv);
}

}  // namespace lockstep
