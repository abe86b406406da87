// One axis's device in real time, in shared memory or in a file.
//
// Its tick is CLOCK_MONOTONIC in units of tick_ns, as in every process of the machine. Steps fall on the ticks that the
// frames define, even if the loop wakes late. Only the host's register writes take effect later by that delay.
#pragma once

#include <string>

#include "services/fpga/served_device.hpp"

namespace lockstep {

struct FpgaOptions {
    std::string machine_file;
    std::string axis;           // its name in the file
    std::string name;           // name of the shared memory; empty: the registers are in `file`
    std::string file;           // path of the register file
    std::string closed_inputs;  // path of the file with the names of closed inputs; empty: none closes
    std::string pushes;         // path of the file with the ways that a hand pushes slides; empty: none is pushed
};

/// Serves until SIGINT or SIGTERM. Returns the exit code: 0 after a requested end, 1 after a failure, with the cause in
/// the log.
int serve_fpga(const FpgaOptions& options, MakeDevice make);

/// The command line of such a process: reads the options, and serves. `summary`: what it does, in a sentence.
int run_fpga_command(int argc, char** argv, const char* summary, MakeDevice make);

}  // namespace lockstep
