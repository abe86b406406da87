// Keeps a machine's processes running: starts them, restarts those that end unexpectedly, and ends all with itself.
//
// It takes no part in motion. When a process dies, the machine comes to rest by its own rules, and moves again only on
// a person's command.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "clients/supervisor/restart_policy.hpp"
#include "clients/supervisor/service_lines.hpp"
#include "clients/supervisor/state_directory.hpp"

namespace lockstep {

class Supervisor {
public:
    Supervisor(const StateDirectory& state, const std::vector<ServiceLine>& lines);

    /// Runs until SIGTERM or SIGINT. Logs to standard error.
    void run();

private:
    struct Service {
        ServiceLine line;
        RestartPolicy policy = {};
        std::optional<ProcessRecord> process;
        std::optional<std::chrono::nanoseconds> start_at;  // nullopt if it runs or was given up
    };

    void start_due();
    void start(Service& service);
    void reap();
    void ended(Service& service, int status);
    /// Waits for the next signal and returns it, or returns 0 when a start is due.
    int wait_for_signal() const;
    void end_all();
    void signal_all(int signal) const;
    bool reap_all(std::chrono::milliseconds time);
    void record() const;

    StateDirectory state_;
    std::vector<Service> services_;
};

}  // namespace lockstep
