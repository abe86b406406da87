// A container for each process of a scenario: podman runs the image that deploy/Dockerfile builds, on the network of
// the sandbox. The image is read from the host's store; podman writes only in the sandbox, which is removed after it.
#pragma once

#include <filesystem>
#include <string>

#include "clients/scenario/runner/child_process.hpp"

namespace lockstep::scenario {

class Containers {
public:
    /// Call it outside of any sandbox. Error: podman or the image is missing, and the remedy.
    static std::expected<Containers, std::string> of(const std::string& image);

    /// The prefix of a process's command line in a sandbox; `network`: the name of its own network, empty: none. The
    /// process can write only to memory that all share: state, flight recorders, device windows.
    CommandLine entry(const std::string& process, const std::string& network) const;

    /// The directory of the process ids, NAME.pid: the started program is podman, which waits for the process.
    static std::filesystem::path pid_folder();

private:
    Containers() = default;

    std::string image_;
    std::string driver_;  // of the host's images
    std::string store_;   // where they are
    std::string group_;   // of control, for all
};

}  // namespace lockstep::scenario
