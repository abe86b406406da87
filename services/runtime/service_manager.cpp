#include "services/runtime/service_manager.hpp"

#include <systemd/sd-daemon.h>

namespace lockstep {

ServiceManager::ServiceManager() {
    std::uint64_t watchdog_us = 0;
    constexpr int kOftener = 4;  // times as often as required
    if (sd_watchdog_enabled(0, &watchdog_us) > 0) { period_ = std::chrono::microseconds(watchdog_us) / kOftener; }
}

void ServiceManager::ready(const std::string& status) const {
    (void)sd_notify(0, ("READY=1\nSTATUS=" + status).c_str());
}

void ServiceManager::alive(std::chrono::nanoseconds now) {
    if (!period_ || now - notified_ < *period_) { return; }
    notified_ = now;
    (void)sd_notify(0, "WATCHDOG=1");
}

void ServiceManager::stopping() const { (void)sd_notify(0, "STOPPING=1"); }

}  // namespace lockstep
