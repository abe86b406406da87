// The processes of a scenario's machine: started, killed, paused and continued by the scenario. None is restarted
// automatically.
#pragma once

#include <sys/types.h>

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/scenario/model/facts.hpp"
#include "clients/supervisor/service_lines.hpp"

namespace lockstep::scenario {

class ProcessSet {
public:
    /// `lines`: complete command lines, with prefixes. `pid_folder`: where a started program writes the id of the
    /// process that it starts in turn, NAME.pid; empty: the started program is the process itself.
    ProcessSet(const std::vector<ServiceLine>& lines, StateDirectory state, std::filesystem::path pid_folder = {});

    /// Errors: the process is not in the right state (running, not running), or it cannot be started.
    std::expected<void, std::string> start(const std::string& name);
    std::expected<void, std::string> kill(const std::string& name);
    std::expected<void, std::string> pause(const std::string& name);
    std::expected<void, std::string> unpause(const std::string& name);
    /// Terminates the process, by force if it does not end in time, and starts it.
    std::expected<void, std::string> restart(const std::string& name);

    /// Running and not paused.
    bool is_active(const std::string& name);
    /// Continues and terminates all.
    void end_all();

    /// A check that no process ended unexpectedly, with how it ended.
    Check exit_check();

private:
    struct Process {
        ServiceLine line;
        pid_t pid = 0;  // of the started program; 0: none
        bool is_paused = false;
        bool is_killed = false;  // and about to end
        bool runs() const { return pid != 0 && !is_killed; }
    };

    Process* find(const std::string& name);
    std::expected<Process*, std::string> running(const std::string& name);
    void reap();
    /// The id of the process itself, awaited where another program starts it. 0: it has ended.
    pid_t pid_of(const Process& process) const;
    std::filesystem::path pid_file(const Process& process) const;
    void send(const Process& process, int signal) const;
    void signal_end(const Process& process, int signal) const;
    void wait_for_end(Process& process);
    /// False: it has not ended in time.
    bool end(Process& process, int signal);

    StateDirectory state_;
    std::filesystem::path pid_folder_;
    std::vector<Process> processes_;
    std::string unexpected_exits_;  // which, and how
};

}  // namespace lockstep::scenario
