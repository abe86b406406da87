// The processes of a scenario's machine. The scenario starts, kills, pauses and continues them. No process is restarted
// automatically.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "clients/scenario/model/facts.hpp"
#include "clients/supervisor/service_lines.hpp"

namespace lockstep::scenario {

class ProcessSet {
public:
    /// `lines`: complete command lines, with prefixes. If `pid_folder` is set, a started program is only a launcher and
    /// writes the process's id to NAME.pid there. If it is empty, the started program is the process itself.
    ProcessSet(const std::vector<ServiceLine>& lines, StateDirectory state, std::filesystem::path pid_folder = {});

    /// Fails if the process is not in the right state (running, not running) or cannot be started.
    std::expected<void, std::string> start(const std::string& name);
    std::expected<void, std::string> kill(const std::string& name);
    std::expected<void, std::string> pause(const std::string& name);
    std::expected<void, std::string> unpause(const std::string& name);
    /// Terminates the process, by force if it does not end in time, and starts it.
    std::expected<void, std::string> restart(const std::string& name);

    /// True if the process is running and not paused.
    bool is_active(const std::string& name);
    /// Continues and terminates all.
    void end_all();

    /// The check that no process ended unexpectedly. It says which process did, and how.
    Check exit_check();

private:
    struct Process {
        ServiceLine line;
        std::optional<pid_t> pid;  // of the started program
        bool is_paused = false;
        bool is_killed = false;  // SIGKILL was sent, and the process was not reaped yet
        bool runs() const { return pid && !is_killed; }
    };

    Process* find(const std::string& name);
    std::expected<Process*, std::string> running(const std::string& name);
    void reap();
    /// Returns the id of the process itself, and waits for it if a launcher starts the process. nullopt if it has
    /// ended.
    std::optional<pid_t> pid_of(const Process& process) const;
    std::filesystem::path pid_file(const Process& process) const;
    void send(const Process& process, int signal) const;
    void signal_end(const Process& process, int signal) const;
    void wait_for_end(Process& process);
    /// Returns false if the process has not ended in time.
    bool end(Process& process, int signal);

    StateDirectory state_;
    std::filesystem::path pid_folder_;
    std::vector<Process> processes_;
    std::string unexpected_exits_;  // the processes and how each ended
};

}  // namespace lockstep::scenario
