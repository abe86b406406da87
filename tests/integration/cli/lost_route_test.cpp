// lo goes down and comes up again, without its multicast route: the record is published again anyway.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <lcm/lcm-cpp.hpp>

#include "services/network/route.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

class LostRoute : public OwnMachine {
protected:
    /// Whether any message of the record is received within the bound.
    bool is_published() const {
        lcm::LCM lcm(lcm_url());
        bool has_come = false;
        struct Note {
            bool* has_come;
            void take(const lcm::ReceiveBuffer*, const std::string&) { *has_come = true; }
        } note{&has_come};
        lcm.subscribe(".*", &Note::take, &note);
        return eventually([&] {
            lcm.handleTimeout(10);
            return has_come;
        });
    }
};

TEST_F(LostRoute, IsAddedAgainAndTheRecordContinues) {
    if (geteuid() != 0) { GTEST_SKIP() << "a network of its own needs root"; }
    bring_up();
    ASSERT_TRUE(is_published());
    ASSERT_EQ(std::system("ip link set lo down && ip link set lo up"), 0);
    EXPECT_TRUE(eventually([] { return route_interface("239.255.76.67") == "lo"; }));
    EXPECT_TRUE(is_published());
    EXPECT_TRUE(eventually([this] {  // a thread writes the log, in the background
        const std::string logs = text_of_log("coordinator") + text_of_log("axis-X") + text_of_log("axis-Y");
        return logs.contains("multicast is no longer routed to lo; this process has added the route again");
    }));
}

}  // namespace
}  // namespace lockstep
