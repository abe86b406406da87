// Keeps LCM's multicast route. The kernel drops the routes of an interface that goes down, and does not restore the
// route of lo when lo comes up again. Without this watch, the record would be lost from then on.
#pragma once

#include <memory>
#include <string>
#include <thread>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

class RouteWatch {
public:
    /// `address` is LCM's multicast address. `interface` is the interface of its route, now and always.
    RouteWatch(std::string address, std::string interface);

private:
    void watch(const std::stop_token& stop) const;
    /// If the route is lost, adds the one of lo if this process may. Returns the text to report; empty if the route
    /// exists.
    std::string restore() const;

    std::string address_;
    std::string interface_;
    std::jthread thread_;
};

/// Returns null if LCM does not use multicast or has no route.
std::unique_ptr<RouteWatch> watch_route(const NetworkConfig& network);

}  // namespace lockstep
