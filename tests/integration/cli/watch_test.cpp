// lockstep watch with a live machine: on a terminal, and without one.
#include <gmock/gmock.h>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/cli/terminal.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::EndsWith;

using Watch = OwnMachine;

constexpr const char* kScreenBefore = "\x1b[?7h\x1b[?25h\x1b[?1049l";

TEST_F(Watch, ShowsALiveMachineAndGivesTheTerminalBack) {
    bring_up();
    for (const char key : {'q', '\x03'}) {
        Terminal terminal("watch");
        ASSERT_TRUE(terminal.shows("setpoint slack")) << terminal.text();
        EXPECT_FALSE(terminal.echoes());
        terminal.type(std::string(1, key));
        EXPECT_EQ(terminal.wait(), 0);
        EXPECT_THAT(terminal.text(), EndsWith(kScreenBefore));
        EXPECT_TRUE(terminal.echoes());
    }
}

TEST_F(Watch, WithoutATerminalWritesLines) {
    bring_up();
    ChildProcess watch(LOCKSTEP_COMMAND, {"watch"});
    EXPECT_TRUE(
        eventually([&] { return watch.out().find(": Idle; X not homed; Y not homed\n") != std::string::npos; }));
    watch.signal(SIGINT);
    const Ran ran = watch.wait();
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out.find('\x1b'), std::string::npos);
}

/// An axis's figures after a move: every step compared with the plan, every frame in time.
TEST_F(Watch, LiveFiguresAreInTheStatus) {
    bring_up_and_home();
    ChildProcess move(LOCKSTEP_COMMAND, {"move", "X=60", "Y=20", "--feed", "1200"});
    proto::HealthReport seen;
    EXPECT_TRUE(eventually([&] {
        seen = status().axes(0).health();
        return seen.has_setpoint_slack_ms() && seen.has_step_lateness_us();
    }));
    EXPECT_EQ(move.wait().code, 0);
    EXPECT_EQ(seen.step_lateness_us().min(), 0);  // the device counts the machine's own clock
    EXPECT_EQ(seen.step_lateness_us().max(), 0);
    EXPECT_GT(seen.step_interval_us().min(), 0);
    EXPECT_GT(seen.setpoint_slack_ms().min(), 0);
    EXPECT_LE(seen.setpoint_slack_ms().max(), 780);  // sent ahead by 39 slots
    EXPECT_GT(seen.loop_max_us(), 0);
    EXPECT_GE(seen.loop_max_us(), seen.loop_p50_us());
    EXPECT_GT(seen.least_free_segments(), 0U);
    EXPECT_GT(seen.least_free_captures(), 0U);
    EXPECT_EQ(seen.lost_captures(), 0U);
}

}  // namespace
}  // namespace lockstep
