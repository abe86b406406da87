#include "services/network/multicast.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "services/network/lcm_url.hpp"
#include "services/network/route.hpp"

namespace lockstep {
namespace {

constexpr const char* kMulticastRange = "224.0.0.0/4";
constexpr const char* kDefaultGroup = "239.255.76.67";

std::string remedy(const std::string& interface) {
    return fmt::format("run as root: ip route add {} dev {}{}", kMulticastRange, interface,
                       (interface == "lo" ? " (and, if nothing is received: ip link set lo multicast on)" : ""));
}

/// Runs `ip route add 224.0.0.0/4 dev lo` without a shell. Returns whether it succeeded. It does not call fork(),
/// because copying the page tables of a running service would delay its loop.
bool add_loopback_route() {
    std::array<const char*, 7> words{"ip", "route", "add", kMulticastRange, "dev", "lo", nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // The caller reports the failure, so the error text of `ip` is not shown.
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int error = posix_spawnp(&child, "ip", &actions, nullptr, const_cast<char**>(words.data()), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) { return false; }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::expected<void, std::string> check_multicast(const NetworkConfig& network) {
    const auto url = parse_lcm_url(network.lcm_url);
    if (!url) { return std::unexpected(url.error()); }
    if (!url->is_multicast()) { return {}; }
    const auto interface = route_interface(url->address);
    if (!interface) { return std::unexpected("LCM: " + interface.error() + "; " + remedy(network.interface)); }
    if (url->ttl == 0 || *interface == network.interface) { return {}; }
    return std::unexpected(
        fmt::format("LCM: ttl {} would send to {} through interface {}, not {}; {}, or set ttl=0 in the LCM URL",
                    url->ttl, url->address, *interface, network.interface, remedy(network.interface)));
}

bool needs_loopback_multicast(const NetworkConfig& network) {
    if (network.interface == "lo") { return true; }
    const auto url = parse_lcm_url(network.lcm_url);
    return url && url->is_multicast() && url->ttl == 0 && !route_interface(url->address);
}

std::expected<bool, std::string> ensure_loopback_multicast() {
    if (route_interface(kDefaultGroup) == "lo") { return false; }
    if (add_loopback_route()) { return true; }
    if (route_interface(kDefaultGroup) == "lo") {  // another process has added it meanwhile
        return false;
    }
    return std::unexpected("cannot route multicast to lo; " + remedy("lo"));
}

}  // namespace lockstep
