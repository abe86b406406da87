// What a service tells the systemd that started it, if one did: that it is up, that it is alive, that it ends.
#pragma once

#include <chrono>
#include <string>

namespace lockstep {

class ServiceManager {
public:
    ServiceManager();

    void ready(const std::string& status) const;
    /// Each loop: the watchdog is told of as often as it wants to be. Who does not come here is ended and started
    /// again.
    void alive(std::chrono::nanoseconds now);
    void stopping() const;

private:
    std::chrono::nanoseconds period_{};  // 0: there is no watchdog
    std::chrono::nanoseconds told_{};
};

}  // namespace lockstep
