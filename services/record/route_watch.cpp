#include "services/record/route_watch.hpp"

#include <chrono>
#include <utility>

#include "services/network/lcm_url.hpp"
#include "services/network/multicast.hpp"
#include "services/network/route.hpp"
#include "services/runtime/log.hpp"
#include "services/runtime/real_time.hpp"
#include "services/runtime/sleep.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::seconds kLookEvery{1};

}  // namespace

RouteWatch::RouteWatch(std::string address, std::string interface)
    : address_(std::move(address)),
      interface_(std::move(interface)),
      thread_([this](const std::stop_token& stop) { watch(stop); }) {}

std::string RouteWatch::restore() const {
    const auto route = route_interface(address_);
    if (route && *route == interface_) { return ""; }
    const std::string lost = "LCM: multicast is no longer routed to " + interface_;
    if (interface_ != "lo") { return lost + "; run as root: ip route add 224.0.0.0/4 dev " + interface_; }
    const auto added = ensure_loopback_multicast();
    return lost + "; " + (added ? "this process has added the route again" : added.error());
}

/// Reports the same problem only once until the route exists again.
void RouteWatch::watch(const std::stop_token& stop) const {
    leave_real_time();
    std::string reported;
    while (sleep_unless(stop, kLookEvery)) {
        const std::string text = restore();
        if (!text.empty() && text != reported) { log_warning(text); }
        reported = text;
    }
}

std::unique_ptr<RouteWatch> watch_route(const NetworkConfig& network) {
    const auto url = parse_lcm_url(network.lcm_url);
    if (!url || !url->is_multicast()) { return nullptr; }
    const auto interface = route_interface(url->address);
    return interface ? std::make_unique<RouteWatch>(url->address, *interface) : nullptr;
}

}  // namespace lockstep
