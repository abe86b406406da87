// Asks the kernel by rtnetlink (see rtnetlink(7), RTM_GETROUTE), because other sources do not show the interface:
// /proc/net/route has no policy routes, and a socket's chosen source address is not lo's address even if the route
// leads to lo.
#include "services/network/route.hpp"

#include <arpa/inet.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace lockstep {
namespace {

struct RouteRequest {
    nlmsghdr header{};
    rtmsg route{};
    rtattr attribute{};
    in_addr destination{};
};

using Answer = std::array<char, 4096>;

std::string failure(const std::string& address, int error) {
    return "no route to " + address + ": " + std::strerror(error);
}

RouteRequest request_for(in_addr destination) {
    RouteRequest request;
    request.header.nlmsg_len = sizeof request;
    request.header.nlmsg_type = RTM_GETROUTE;
    request.header.nlmsg_flags = NLM_F_REQUEST;
    request.route.rtm_family = AF_INET;
    request.route.rtm_dst_len = 32;
    request.attribute.rta_type = RTA_DST;
    request.attribute.rta_len = RTA_LENGTH(sizeof destination);
    request.destination = destination;
    return request;
}

/// Sends the request and receives the answer. Returns its length, or minus errno.
int ask_kernel(const RouteRequest& request, Answer& answer) {
    const int netlink = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
    if (netlink < 0) { return -errno; }
    auto length = send(netlink, &request, sizeof request, 0);
    if (length >= 0) { length = recv(netlink, answer.data(), answer.size(), 0); }
    const int error = errno;
    close(netlink);
    return length < 0 ? -error : static_cast<int>(length);
}

/// Returns the index of the route's outgoing interface, or 0.
unsigned outgoing_interface(const nlmsghdr* header) {
    auto* route = static_cast<rtmsg*>(NLMSG_DATA(header));
    auto length = static_cast<unsigned>(RTM_PAYLOAD(header));
    for (rtattr* item = RTM_RTA(route); RTA_OK(item, length); item = RTA_NEXT(item, length)) {
        if (item->rta_type != RTA_OIF) { continue; }
        unsigned index = 0;
        std::memcpy(&index, RTA_DATA(item), sizeof index);
        return index;
    }
    return 0;
}

}  // namespace

std::expected<std::string, std::string> route_interface(const std::string& address) {
    in_addr destination{};
    if (inet_pton(AF_INET, address.c_str(), &destination) != 1) {
        return std::unexpected("'" + address + "' is not an IPv4 address");
    }
    alignas(nlmsghdr) Answer answer{};
    const int length = ask_kernel(request_for(destination), answer);
    if (length < 0) { return std::unexpected(failure(address, -length)); }
    const auto* header = reinterpret_cast<const nlmsghdr*>(answer.data());
    if (!NLMSG_OK(header, static_cast<unsigned>(length))) { return std::unexpected(failure(address, EPROTO)); }
    if (header->nlmsg_type == NLMSG_ERROR) {
        return std::unexpected(failure(address, -static_cast<const nlmsgerr*>(NLMSG_DATA(header))->error));
    }
    std::array<char, IF_NAMESIZE> name{};
    if (if_indextoname(outgoing_interface(header), name.data()) == nullptr) {
        return std::unexpected(failure(address, ENODEV));
    }
    return std::string(name.data());
}

}  // namespace lockstep
