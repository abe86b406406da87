#include "services/network/interface_identity.hpp"

#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

namespace lockstep {
namespace {

std::optional<InterfaceIdentity> ask_kernel(int socket, ifreq request) {
    if (ioctl(socket, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) { return std::nullopt; }
    if (ioctl(socket, SIOCGIFADDR, &request) != 0) { return std::nullopt; }
    sockaddr_in address{};
    std::memcpy(&address, &request.ifr_addr, sizeof address);
    if (ioctl(socket, SIOCGIFINDEX, &request) != 0) { return std::nullopt; }
    return InterfaceIdentity{static_cast<unsigned>(request.ifr_ifindex), address.sin_addr.s_addr};
}

}  // namespace

std::optional<InterfaceIdentity> interface_identity(const std::string& name) {
    ifreq request{};
    if (name.empty() || name.size() >= sizeof request.ifr_name) { return std::nullopt; }
    std::memcpy(request.ifr_name, name.c_str(), name.size() + 1);
    const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket < 0) { return std::nullopt; }
    const auto identity = ask_kernel(socket, request);
    close(socket);
    return identity;
}

}  // namespace lockstep
