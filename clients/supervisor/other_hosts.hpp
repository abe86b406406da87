// Runs the same verb on the machine's other hosts, over ssh.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "clients/text/output.hpp"
#include "core/machine.hpp"

namespace lockstep {

struct AllHosts {
    bool asked = false;
    std::string ssh = "ssh -o BatchMode=yes";  // words, which the host's name follows
};

/// While it exists, `lockstep VERB...` runs on every host that the machine's file names, but not on this one.
class OtherHosts {
public:
    /// `machine_file`: as the option named it; empty: not named. The same path is named on all hosts.
    OtherHosts(const AllHosts& all, const MachineConfig& machine, const std::string& machine_file,
               const std::vector<std::string>& verb);
    ~OtherHosts();
    OtherHosts(const OtherHosts&) = delete;
    OtherHosts& operator=(const OtherHosts&) = delete;

    /// Waits for all, and prints the output of each after its host's name. False: one failed.
    bool finish(Output& output, std::size_t lines_where_well = std::numeric_limits<std::size_t>::max());

private:
    struct Remote {
        std::string host;
        int pid = 0;
        int output = -1;
    };
    std::vector<Remote> remotes_;
};

}  // namespace lockstep
