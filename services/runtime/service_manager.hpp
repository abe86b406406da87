// Notifies the systemd that started this service, if any: that it is ready, alive, or ending.
#pragma once

#include <chrono>
#include <string>

namespace lockstep {

class ServiceManager {
public:
    ServiceManager();

    void ready(const std::string& status) const;
    /// Call it in each loop: notifies the watchdog as often as it requires. systemd ends and restarts a service that
    /// does not.
    void alive(std::chrono::nanoseconds now);
    void stopping() const;

private:
    std::chrono::nanoseconds period_{};  // 0: there is no watchdog
    std::chrono::nanoseconds notified_{};
};

}  // namespace lockstep
