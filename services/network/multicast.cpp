#include "services/network/multicast.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "services/network/lcm_url.hpp"
#include "services/network/route.hpp"

namespace lockstep {
namespace {

constexpr const char* kMulticastRange = "224.0.0.0/4";
constexpr const char* kDefaultGroup = "239.255.76.67";

std::string remedy(const std::string& interface) {
    return "run as root: ip route add " + std::string(kMulticastRange) + " dev " + interface +
           (interface == "lo" ? " (and, if nothing is heard: ip link set lo multicast on)" : "");
}

/// Runs `ip route VERB 224.0.0.0/4 dev lo` without a shell. True: it succeeded.
bool change_loopback_route(const char* verb) {
    const pid_t child = fork();
    if (child < 0) { return false; }
    if (child == 0) {
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);  // what failed is said by the caller
        execlp("ip", "ip", "route", verb, kMulticastRange, "dev", "lo", static_cast<char*>(nullptr));
        _exit(127);
    }
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
    return std::unexpected("LCM: ttl " + std::to_string(url->ttl) + " would send " + url->address + " out by " +
                           *interface + ", not by " + network.interface + "; " + remedy(network.interface) +
                           ", or set ttl=0 in the LCM URL");
}

std::expected<bool, std::string> ensure_loopback_multicast() {
    if (route_interface(kDefaultGroup) == "lo") { return false; }
    if (change_loopback_route("add")) { return true; }
    if (route_interface(kDefaultGroup) == "lo") {  // another process was quicker
        return false;
    }
    return std::unexpected("cannot route multicast to lo; " + remedy("lo"));
}

std::expected<void, std::string> remove_loopback_multicast() {
    if (change_loopback_route("del")) { return {}; }
    return std::unexpected("cannot remove the multicast route of lo; run as root: ip route del " +
                           std::string(kMulticastRange) + " dev lo");
}

}  // namespace lockstep
