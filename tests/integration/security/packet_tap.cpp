#include "tests/integration/security/packet_tap.hpp"

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace lockstep {
namespace {

// Offsets in an Ethernet frame that has an IPv4 packet without options.
constexpr std::size_t kProtocolAt = 14 + 9;
constexpr std::size_t kReceiver = 14 + 16;
constexpr std::size_t kReceiverPort = 14 + 20 + 2;
constexpr std::size_t kPayload = 14 + 20 + 8;
constexpr char kUdp = 17;

sockaddr_ll on_loopback() {
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_IP);
    address.sll_ifindex = static_cast<int>(if_nametoindex("lo"));
    return address;
}

}  // namespace

PacketTap::PacketTap()
    : socket_(::socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC, htons(ETH_P_IP))),
      sender_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const in_addr lo{htonl(INADDR_LOOPBACK)};
    (void)::setsockopt(sender_, IPPROTO_IP, IP_MULTICAST_IF, &lo, sizeof lo);
    const sockaddr_ll address = on_loopback();
    constexpr int kBuffer = 32 << 20;
    (void)::setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &kBuffer, sizeof kBuffer);
    (void)::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    listener_ = std::thread([this] { listen(); });
}

PacketTap::~PacketTap() {
    (void)stop();
    for (const int socket : {socket_, sender_}) {
        if (socket >= 0) { ::close(socket); }
    }
}

/// On lo every packet is seen twice: outgoing, and incoming.
void PacketTap::listen() {
    std::array<char, 65600> buffer{};
    while (!stopped_ && works()) {
        pollfd ready{.fd = socket_, .events = POLLIN, .revents = 0};
        if (::poll(&ready, 1, 50) <= 0) { continue; }
        sockaddr_ll from{};
        socklen_t size = sizeof from;
        const ssize_t length =
            ::recvfrom(socket_, buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
        const bool is_udp = length > static_cast<ssize_t>(kPayload) && buffer[kProtocolAt] == kUdp;
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

/// Sends the content as a new datagram: the kernel drops a frame put onto lo with an address of lo as its sender.
bool PacketTap::send(const std::string& packet) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    std::memcpy(&to.sin_addr, &packet[kReceiver], sizeof to.sin_addr);
    std::memcpy(&to.sin_port, &packet[kReceiverPort], sizeof to.sin_port);
    const std::size_t size = packet.size() - kPayload;
    const ssize_t sent =
        ::sendto(sender_, &packet[kPayload], size, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    return sent == static_cast<ssize_t>(size);
}

std::size_t PacketTap::send_again() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(packets_, [this](const std::string& packet) { return send(packet); }));
}

}  // namespace lockstep
