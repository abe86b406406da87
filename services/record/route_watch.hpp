// Keeps LCM's multicast route. The kernel drops the routes of an interface that goes down, and nobody brings that of lo
// back when it comes up again: the record would be lost from then on.
#pragma once

#include <memory>
#include <string>
#include <thread>

#include "core/machine.hpp"

namespace lockstep {

class RouteWatch {
public:
    /// address: of LCM's multicast. interface: by which it is routed now, and is to be.
    RouteWatch(std::string address, std::string interface);

private:
    void watch(const std::stop_token& stop) const;
    /// Adds the route of lo where this process may. What there is to report; empty: nothing.
    std::string mend() const;

    std::string address_;
    std::string interface_;
    std::jthread thread_;
};

/// Null: LCM does not multicast, or is not routed.
std::unique_ptr<RouteWatch> watch_route(const NetworkConfig& network);

}  // namespace lockstep
