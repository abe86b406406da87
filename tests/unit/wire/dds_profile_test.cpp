// The settings bind Cyclone DDS to the configured interface. It uses multicast unless peers are named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/wire/dds/domain.hpp"
#include "services/wire/dds/peer_discovery.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(DdsProfile, DiscoveryUsesMulticastUnlessPeersAreNamed) {
    const auto profile = dds_profile({.interface = "eth0"});
    EXPECT_THAT(*profile, HasSubstr(R"(<NetworkInterface name="eth0")"));
    EXPECT_THAT(*profile, Not(HasSubstr("AllowMulticast")));
    EXPECT_THAT(*profile, Not(HasSubstr("Peer")));
}

TEST(DdsProfile, NamedPeersAreContactedWithoutMulticast) {
    const auto profile = dds_profile({.interface = "eth0", .peers = {"10.0.0.1", "mill-x"}});
    EXPECT_THAT(*profile, HasSubstr("<AllowMulticast>false</AllowMulticast>"));
    EXPECT_THAT(*profile, HasSubstr(R"(<Peers><Peer address="10.0.0.1"/><Peer address="mill-x"/></Peers>)"));
    EXPECT_THAT(*profile, HasSubstr("<ParticipantIndex>auto</ParticipantIndex>"));
}

TEST(DdsProfile, ManyProcessesContactEachOtherLessOften) {
    const auto few = dds_profile({.processes = 4});
    const auto many = dds_profile({.processes = 65});
    EXPECT_THAT(*few, HasSubstr("max=\"20 ms\">2 ms</HeartbeatInterval><NackDelay>0 ms"));
    EXPECT_THAT(*few, HasSubstr("<SPDPInterval>200 ms</SPDPInterval><LeaseDuration>1000 ms"));
    EXPECT_THAT(*many, HasSubstr("max=\"1340 ms\">134 ms</HeartbeatInterval><NackDelay>66 ms"));
    EXPECT_THAT(*many, HasSubstr("<SPDPInterval>2000 ms</SPDPInterval><LeaseDuration>10000 ms"));
}

TEST(DdsProfile, TheSendBufferHoldsThePacketsToAbsentPeers) {
    EXPECT_EQ(peer_send_buffer(1), kMotionSendBuffer) << "the process itself is present";
    EXPECT_GT(peer_send_buffer(5), peer_send_buffer(4));
    const auto profile = dds_profile({.interface = "eth0", .peers = {"10.0.0.1", "10.0.0.2"}});
    EXPECT_THAT(*profile, HasSubstr("<SocketSendBufferSize max=\"" + std::to_string(peer_send_buffer(2)) + " B\"/>"));
}

TEST(DdsProfile, ReceiveBuffersAreSmallEnoughToBeFilledSoon) {
    EXPECT_THAT(*dds_profile({.interface = "eth0"}), HasSubstr("<ReceiveBufferSize>256 KiB</ReceiveBufferSize>"));
}

TEST(DdsProfile, AnInvalidInterfaceNameIsRefused) {
    EXPECT_FALSE(dds_profile({.interface = "\"/><Tracing"}).has_value());
}

}  // namespace
}  // namespace lockstep
