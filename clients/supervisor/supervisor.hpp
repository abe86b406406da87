// Keeps a machine's processes running: starts them, restarts those that end unexpectedly, and ends all with itself.
//
// It takes no part in motion. A machine whose process died has come to rest by its own rules, and moves again only
// on a person's command.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "clients/supervisor/restart_policy.hpp"
#include "clients/supervisor/service_lines.hpp"
#include "clients/supervisor/state_directory.hpp"

namespace lockstep {

class Supervisor {
public:
    Supervisor(const StateDirectory& state, const std::vector<ServiceLine>& lines);

    /// Until SIGTERM or SIGINT. Its log goes to standard error.
    void run();

private:
    struct Service {
        ServiceLine line;
        RestartPolicy policy = {};
        std::optional<ProcessRecord> process = {};
        std::optional<std::chrono::nanoseconds> start_at = {};  // nothing: it runs, or was given up
    };

    void start_due();
    void start(Service& service);
    void reap();
    void ended(Service& service, int status);
    /// The next signal, or 0 when a start is due.
    int wait_for_signal() const;
    void end_all();
    void signal_all(int signal) const;
    bool reap_all(std::chrono::milliseconds time);
    void record() const;

    StateDirectory state_;
    std::vector<Service> services_;
};

}  // namespace lockstep
