// Network, process and mount namespaces of its own for one scenario. However this process ends, it leaves nothing:
// the kernel ends the sandbox's processes and removes its networks and files.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <functional>
#include <string>

namespace lockstep::scenario {

/// Within a sandbox: a directory in memory, removed with it.
std::filesystem::path sandbox_folder();

class Sandbox {
public:
    /// Runs a function in a new sandbox; its return value is the result. Call it while this process has one thread.
    /// Error: why no sandbox can be made, and the remedy.
    static std::expected<Sandbox, std::string> start(const std::function<std::string()>& run);

    Sandbox(Sandbox&& other) noexcept;
    Sandbox& operator=(Sandbox&&) = delete;
    Sandbox(const Sandbox&) = delete;
    /// Ends the sandbox if it still runs.
    ~Sandbox();

    /// Becomes readable when there is output.
    int readable() const { return pipe_; }
    /// Reads the available output. True: the sandbox has ended, and its result is complete.
    bool read_output();
    /// Once it has ended. Error: how it ended without a result.
    std::expected<std::string, std::string> result() const;

private:
    Sandbox(pid_t keeper, int pipe) : keeper_(keeper), pipe_(pipe) {}

    pid_t keeper_;  // the process outside; the sandbox ends with it
    int pipe_;
    std::string output_;
    bool ended_ = false;
};

}  // namespace lockstep::scenario
