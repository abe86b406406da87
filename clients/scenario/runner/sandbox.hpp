// Runs one scenario in its own network, process and mount namespaces. When this process ends, for any reason, the
// kernel ends the sandbox's processes and removes its networks and files.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <functional>
#include <string>

#include "services/files/descriptor.hpp"

namespace lockstep::scenario {

/// A directory in memory inside the sandbox. The kernel removes it with the sandbox.
std::filesystem::path sandbox_folder();

class Sandbox {
public:
    /// Runs a function in a new sandbox; its return value is the result. Call it while this process has one thread. The
    /// error says why no sandbox can be made, with the remedy.
    static std::expected<Sandbox, std::string> start(const std::function<std::string()>& run);

    Sandbox(Sandbox&&) = default;
    /// Ends the sandbox if it still runs.
    ~Sandbox();

    /// Becomes readable when there is output.
    int readable() const { return pipe_.get(); }
    /// Reads the available output. Returns true when the sandbox has ended and its result is complete.
    bool read_output();
    /// Call it when the sandbox has ended. The error says why there is no result.
    std::expected<std::string, std::string> result() const;

private:
    Sandbox(pid_t keeper, Descriptor pipe) : keeper_(keeper), pipe_(std::move(pipe)) {}

    pid_t keeper_;  // the process outside; the sandbox ends with it
    Descriptor pipe_;
    std::string output_;
    bool ended_ = false;
};

}  // namespace lockstep::scenario
