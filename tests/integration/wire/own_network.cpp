#include "tests/integration/wire/own_network.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>

#include "services/network/multicast.hpp"

namespace lockstep {
namespace {

class NetworkEnvironment : public testing::Environment {
public:
    void SetUp() override {
        const bool is_own = unshare(CLONE_NEWNET) == 0 && std::system("ip link set lo up") == 0;
        const auto added = ensure_loopback_multicast();
        ASSERT_TRUE(added) << added.error();
        remove_route_ = *added && !is_own;  // an own network ends with the process
    }
    void TearDown() override {
        if (remove_route_) { EXPECT_EQ(std::system("ip route del 224.0.0.0/4 dev lo"), 0); }
    }

private:
    bool remove_route_ = false;
};

const auto* const kNetworkEnvironment = testing::AddGlobalTestEnvironment(new NetworkEnvironment);

}  // namespace

NetworkConfig own_network() {
    static std::uint32_t calls = 0;
    const auto number = static_cast<std::uint32_t>(getpid()) + 7919 * calls++;
    NetworkConfig network;
    network.domain = 10 + number % 200;
    network.lcm_url = "udpm://239.255.76.67:" + std::to_string(20000 + number % 10000) + "?ttl=0&recv_buf_size=4194304";
    return network;
}

}  // namespace lockstep
