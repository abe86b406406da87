// Runs each process of a scenario in a container: podman runs the image that deploy/Dockerfile builds, on the network
// of the sandbox. The image is read from the host's store. Podman writes only inside the sandbox, which is removed
// afterwards.
#pragma once

#include <filesystem>
#include <string>

#include "clients/scenario/runner/child_process.hpp"

namespace lockstep::scenario {

class Containers {
public:
    /// Call it outside of any sandbox. Fails if podman or the image is missing; the error has the remedy.
    static std::expected<Containers, std::string> of(const std::string& image);

    /// The prefix of a process's command line in a sandbox. `network` names the process's own network namespace; empty
    /// for no network. The process can write only to memory that all processes share: state, flight recorders, device
    /// windows.
    CommandLine entry(const std::string& process, const std::string& network) const;

    /// The directory of the files NAME.pid. The started program is podman; the file has the id of the process that it
    /// waits for.
    static std::filesystem::path pid_folder();

private:
    Containers() = default;

    std::string image_;
    std::string driver_;  // storage driver of the host's images
    std::string store_;   // directory of the host's images
    std::string group_;   // control group of all the containers
};

}  // namespace lockstep::scenario
