// A container for each process of a scenario: podman runs the image that deploy/Dockerfile builds, on the network that
// the stage makes. The image is read where the host keeps it; all that podman writes is the world's, and gone with it.
#pragma once

#include <filesystem>
#include <string>

#include "clients/scenario/runner/child.hpp"

namespace lockstep::scenario {

class Containers {
public:
    /// Call it outside of any world. Error: podman or the image is not there, and the remedy.
    static std::expected<Containers, std::string> of(const std::string& image);

    /// What a process's command line begins with, in a world; `network`: the name of its own, empty: none. It can
    /// write to memory alone, which all share: state, notes, devices' windows.
    Words entry(const std::string& process, const std::string& network) const;

    /// The directory in which the processes' numbers are, NAME.pid: what is started is podman, which waits for them.
    static std::filesystem::path numbers();

private:
    Containers() = default;

    std::string image_;
    std::string driver_;  // of the host's images
    std::string store_;   // where they are
    std::string group_;   // of control, for all
};

}  // namespace lockstep::scenario
