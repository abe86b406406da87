// One axis's simulated device in real time, in shared memory or in a file.
//
// Its tick is CLOCK_MONOTONIC in units of tick_ns, as in every process of the machine. Steps fall on the ticks that
// the frames define, however late the loop wakes; only the host's register writes take effect that much later.
#pragma once

#include <string>

namespace lockstep {

struct FpgaOptions {
    std::string machine_file;
    std::string axis;  // its name in the file
    std::string name;  // of the shared memory; empty: in a file
    std::string file;  // its path
};

/// Serves until SIGINT or SIGTERM. Returns the exit code: 0 ended as asked, 1 failed, the cause is in the log.
int serve_fpga(const FpgaOptions& options);

}  // namespace lockstep
