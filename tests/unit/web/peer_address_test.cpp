// The address by which a server tells its clients apart.
#include "clients/channel/peer.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

#include <bit>

namespace lockstep {
namespace {

std::string of_six(const char* text) {
    sockaddr_in6 six{.sin6_family = AF_INET6};
    EXPECT_EQ(inet_pton(AF_INET6, text, &six.sin6_addr), 1);
    return peer_address(std::bit_cast<const sockaddr*>(&six));
}

std::string of_four(const char* text) {
    sockaddr_in four{.sin_family = AF_INET};
    EXPECT_EQ(inet_pton(AF_INET, text, &four.sin_addr), 1);
    return peer_address(std::bit_cast<const sockaddr*>(&four));
}

TEST(PeerAddress, IsTheNumberOfIPv4InBothForms) {
    EXPECT_EQ(of_four("192.0.2.7"), "192.0.2.7");
    EXPECT_EQ(of_six("::ffff:192.0.2.7"), "192.0.2.7");
}

TEST(PeerAddress, IsTheNetworkOfIPv6BecauseAHostMayUseAllOfIt) {
    EXPECT_EQ(of_six("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::/64");
    EXPECT_EQ(of_six("2001:db8:1:2:ffff::1"), of_six("2001:db8:1:2::9"));
    EXPECT_NE(of_six("2001:db8:1:3::9"), of_six("2001:db8:1:2::9"));
    EXPECT_EQ(of_six("::1"), "::1");
}

}  // namespace
}  // namespace lockstep
