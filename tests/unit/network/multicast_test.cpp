// LCM's multicast leaves by the configured interface, or not at all.
#include "services/network/multicast.hpp"

#include <gtest/gtest.h>

#include "services/network/lcm_url.hpp"
#include "services/network/route.hpp"

namespace lockstep {
namespace {

TEST(LcmUrl, ReadsTheAddressOfMessages) {
    const auto url = parse_lcm_url("udpm://239.1.2.3:7000?recv_buf_size=4194304&ttl=1");
    ASSERT_TRUE(url) << url.error();
    EXPECT_EQ(url->address, "239.1.2.3");
    EXPECT_EQ(url->port, 7000);
    EXPECT_EQ(url->ttl, 1);
}

TEST(LcmUrl, HasLcmsDefaults) {
    const auto url = parse_lcm_url("udpm://");
    ASSERT_TRUE(url) << url.error();
    EXPECT_EQ(url->address, "239.255.76.67");
    EXPECT_EQ(url->port, 7667);
    EXPECT_EQ(url->ttl, 0);
}

TEST(LcmUrl, NamesTheError) {
    for (const char* wrong : {"udpm://239.1.2.3:70000", "udpm://239.1.2.3:x", "udpm://?ttl=256", "udpm://?ttl=one",
                              "udpm://10.0.0.1:7667", "udpm://example:7667"}) {
        EXPECT_FALSE(parse_lcm_url(wrong)) << wrong;
    }
}

TEST(LcmUrl, OtherProvidersAreNoMulticast) { EXPECT_FALSE(parse_lcm_url("memq://")->is_multicast()); }

TEST(Route, LoopbackLeadsToLo) { EXPECT_EQ(route_interface("127.0.0.1"), "lo"); }

TEST(Route, ATextThatIsNotAnAddressIsRefused) { EXPECT_FALSE(route_interface("lo")); }

TEST(Multicast, ThatWouldLeaveByAnotherInterfaceIsRefused) {
    const NetworkConfig network{.interface = "none0", .lcm_url = "udpm://239.255.76.67:7667?ttl=1"};
    const auto checked = check_multicast(network);
    ASSERT_FALSE(checked);
    EXPECT_NE(checked.error().find("ip route add 224.0.0.0/4 dev none0"), std::string::npos) << checked.error();
}

TEST(Multicast, AnotherCarrierNeedsNoRoute) {
    EXPECT_TRUE(check_multicast({.interface = "none0", .lcm_url = "memq://"}));
}

TEST(Multicast, NeedsTheRouteToLoOnAMachineOfOneHost) {
    EXPECT_TRUE(needs_loopback_multicast({.interface = "lo"}));
    EXPECT_FALSE(needs_loopback_multicast({.interface = "none0", .lcm_url = "memq://"}));
    EXPECT_FALSE(needs_loopback_multicast({.interface = "none0", .lcm_url = "udpm://239.255.76.67:7667?ttl=1"}));
}

}  // namespace
}  // namespace lockstep
