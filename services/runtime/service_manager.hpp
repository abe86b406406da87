// Tells systemd that this service is ready, alive, or ending. Has no effect if systemd did not start it.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace lockstep {

class ServiceManager {
public:
    ServiceManager();

    void ready(const std::string& status) const;
    /// Call it in each loop. It notifies systemd's watchdog as often as required. systemd kills and restarts a service
    /// that does not.
    void alive(std::chrono::nanoseconds now);
    void stopping() const;

private:
    std::optional<std::chrono::nanoseconds> period_;  // nullopt: no watchdog
    std::chrono::nanoseconds notified_{};
};

}  // namespace lockstep
