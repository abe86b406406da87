// Absent peers: packets to them wait in the kernel, on the socket that carries motion.
#include <gtest/gtest.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdlib>

#include "services/wire/dds/interface_sockets.hpp"
#include "services/wire/dds/participant.hpp"
#include "services/wire/dds/peer_discovery.hpp"
#include "tests/integration/wire/eventually.hpp"
#include "tests/integration/wire/own_network.hpp"

namespace lockstep {
namespace {

/// An interface without any other host; ARP fails there.
bool make_lonely_interface() {
    return std::system(
               "ip link add lonely type veth peer name absent && ip link set absent up && "
               "ip link set lonely up && ip addr add 10.9.7.1/24 dev lonely") == 0;
}

struct SendBuffer {
    int waiting = 0;  // bytes, of the socket with the least room
    int room = 0;
};

SendBuffer fullest(const Descriptors& sockets) {
    SendBuffer found{.room = 1 << 30};
    for (const int socket : sockets) {
        int size = 0;
        int unsent = 0;
        socklen_t length = sizeof size;
        if (::getsockopt(socket, SOL_SOCKET, SO_SNDBUF, &size, &length) != 0) { continue; }
        if (::ioctl(socket, SIOCOUTQ, &unsent) != 0) { continue; }
        if (size - unsent < found.room) { found = {.waiting = unsent, .room = size - unsent}; }
    }
    return found;
}

TEST(Peers, ThatAreAbsentLeaveRoomForMotion) {
    NetworkConfig network = own_network();
    if (!make_lonely_interface()) { GTEST_SKIP() << "no network of its own is permitted here"; }
    network.interface = "lonely";
    network.peers = {"10.9.7.1", "10.9.7.2", "10.9.7.3", "10.9.7.4"};
    const auto participant = Participant::open(network, "mill");
    ASSERT_TRUE(participant) << participant.error();
    const Descriptors sockets = udp_sockets();
    int most_waiting = 0;
    int least_room = fullest(sockets).room;
    // Until ARP has given up, and the waiting packets are gone.
    EXPECT_TRUE(eventually([&] {
        const SendBuffer now = fullest(sockets);
        most_waiting = std::max(most_waiting, now.waiting);
        least_room = std::min(least_room, now.room);
        return now.waiting < most_waiting / 2;
    }));
    EXPECT_GT(most_waiting, 0) << "no packet was waiting";
    EXPECT_GE(least_room, kMotionSendBuffer) << "of " << peer_send_buffer(network.peers.size()) << " bytes";
}

}  // namespace
}  // namespace lockstep
