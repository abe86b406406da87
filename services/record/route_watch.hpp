// Keeps LCM's multicast route. The kernel drops the routes of an interface that goes down, and does not restore the one
// of lo when it comes up again: the record would be lost from then on.
#pragma once

#include <memory>
#include <string>
#include <thread>

#include "core/machine.hpp"

namespace lockstep {

class RouteWatch {
public:
    /// address: of LCM's multicast. interface: its present and required route.
    RouteWatch(std::string address, std::string interface);

private:
    void watch(const std::stop_token& stop) const;
    /// Adds the route of lo if this process may. Returns the text to report; empty: nothing.
    std::string restore() const;

    std::string address_;
    std::string interface_;
    std::jthread thread_;
};

/// Null: LCM does not use multicast, or is not routed.
std::unique_ptr<RouteWatch> watch_route(const NetworkConfig& network);

}  // namespace lockstep
