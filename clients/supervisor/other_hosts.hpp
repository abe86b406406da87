// Runs the same verb on the machine's other hosts, over ssh.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "clients/text/output.hpp"
#include "services/files/descriptor.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

struct AllHosts {
    bool asked = false;
    std::string ssh = "ssh -o BatchMode=yes";  // words; the host's name is appended
};

/// Runs `lockstep VERB...` on every host that the machine's file names, except this one, while the object exists.
class OtherHosts {
public:
    /// `machine_file`: the value of the option, empty if not given. All hosts get the same path.
    OtherHosts(const AllHosts& all, const MachineSetup& machine, const std::string& machine_file,
               const std::vector<std::string>& verb);
    ~OtherHosts();
    OtherHosts(const OtherHosts&) = delete;
    OtherHosts& operator=(const OtherHosts&) = delete;

    /// Waits for all hosts, and prints each line of output after its host's name. Returns false if one failed.
    bool finish(Output& output, std::size_t lines_where_well = std::numeric_limits<std::size_t>::max());

private:
    struct Remote {
        std::string host;
        int pid = 0;
        Descriptor output;
    };
    std::vector<Remote> remotes_;
};

}  // namespace lockstep
