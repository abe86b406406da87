#include "tests/integration/security/packet_tap.hpp"

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace lockstep {
namespace {

constexpr std::size_t kProtocol = 14 + 9;  // of an IPv4 packet behind its Ethernet header
constexpr char kUdp = 17;

sockaddr_ll on_loopback() {
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_IP);
    address.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
    return address;
}

}  // namespace

PacketTap::PacketTap() : socket_(::socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC, htons(ETH_P_IP))) {
    const sockaddr_ll address = on_loopback();
    constexpr int kBuffer = 32 << 20;
    (void)::setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &kBuffer, sizeof kBuffer);
    (void)::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    listener_ = std::thread([this] { listen(); });
}

PacketTap::~PacketTap() {
    (void)stop();
    if (socket_ >= 0) { ::close(socket_); }
}

/// On lo every packet goes by twice: as it leaves, and as it comes.
void PacketTap::listen() {
    std::array<char, 65600> buffer{};
    while (!stopped_ && works()) {
        pollfd ready{.fd = socket_, .events = POLLIN, .revents = 0};
        if (::poll(&ready, 1, 50) <= 0) { continue; }
        sockaddr_ll from{};
        socklen_t size = sizeof from;
        const ssize_t length =
            ::recvfrom(socket_, buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
        const bool is_udp = length > static_cast<ssize_t>(kProtocol) && buffer[kProtocol] == kUdp;
        if (is_udp && from.sll_pkttype != PACKET_OUTGOING) {
            packets_.emplace_back(buffer.data(), static_cast<std::size_t>(length));
        }
    }
}

const std::vector<std::string>& PacketTap::stop() {
    stopped_ = true;
    if (listener_.joinable()) { listener_.join(); }
    return packets_;
}

std::size_t PacketTap::send_again() const {
    const sockaddr_ll address = on_loopback();
    std::size_t sent = 0;
    for (const std::string& packet : packets_) {
        const ssize_t length = ::sendto(socket_, packet.data(), packet.size(), 0,
                                        reinterpret_cast<const sockaddr*>(&address), sizeof address);
        sent += length == static_cast<ssize_t>(packet.size()) ? 1 : 0;
    }
    return sent;
}

}  // namespace lockstep
