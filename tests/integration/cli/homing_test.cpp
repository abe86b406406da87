// A person or a lost coordinator ends a homing: the axis rests, the end is reported, and homing works again.
#include <gmock/gmock.h>
#include <signal.h>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// X is far from its switch: it homes for some seconds.
class Homing : public OwnMachine {
protected:
    void configure(MachineSetup& machine) override { machine.axes[0].plant.start_position_mm = 150; }
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up();
    }
    void expect_ended(const Ran& homing) const {
        EXPECT_EQ(homing.code, 1);
        EXPECT_THAT(homing.out, HasSubstr("home: stopped"));
        EXPECT_THAT(homing.out, HasSubstr("not homed: X"));
        const auto after = status();
        EXPECT_EQ(after.phase(), "Idle");
        EXPECT_FALSE(after.axes(0).homed());
        EXPECT_TRUE(after.axes(0).at_rest());
    }
};

TEST_F(Homing, IsEndedByAStopAndWorksAgain) {
    ChildProcess home(LOCKSTEP_COMMAND, {"home"});
    ASSERT_TRUE(becomes("Homing"));
    const Ran stop = run_lockstep({"stop"});
    EXPECT_EQ(stop.code, 0) << stop.err;
    EXPECT_THAT(stop.out, HasSubstr("the machine is Idle"));
    expect_ended(home.wait());
    EXPECT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_TRUE(status().axes(0).homed());
}

TEST_F(Homing, IsEndedByAHold) {
    ChildProcess home(LOCKSTEP_COMMAND, {"home"});
    ASSERT_TRUE(becomes("Homing"));
    const Ran hold = run_lockstep({"hold"});
    EXPECT_EQ(hold.code, 0) << hold.err;
    EXPECT_THAT(hold.out, HasSubstr("lockstep home"));
    expect_ended(home.wait());
}

TEST_F(Homing, IsEndedWhenItsCommandIsInterrupted) {
    ChildProcess home(LOCKSTEP_COMMAND, {"home"});
    ASSERT_TRUE(becomes("Homing"));
    home.signal(SIGINT);
    expect_ended(home.wait());
}

TEST_F(Homing, IsEndedByTheAxisWhenTheCoordinatorIsKilled) {
    ChildProcess home(LOCKSTEP_COMMAND, {"home"});
    ASSERT_TRUE(becomes("Homing"));
    kill(process("coordinator"), SIGKILL);
    ASSERT_TRUE(becomes("Fault")) << "the coordinator is started again, and finds the axis halted";
    EXPECT_NE(home.wait().code, 0);
    const auto halted = status();
    EXPECT_EQ(halted.axes(0).fault().name(), "coordinator-silent");
    EXPECT_TRUE(halted.axes(0).at_rest());
    EXPECT_FALSE(halted.axes(0).homed());
    EXPECT_EQ(run_lockstep({"reset"}).code, 0);
    ASSERT_TRUE(becomes("Idle"));
    EXPECT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_TRUE(status().axes(0).homed());
}

TEST_F(Homing, IsEndedBeforeTheMachineIsTakenDown) {
    ChildProcess home(LOCKSTEP_COMMAND, {"home"});
    ASSERT_TRUE(becomes("Homing"));
    const Ran down = run_lockstep({"down"});
    EXPECT_EQ(down.code, 0) << down.err;
    EXPECT_THAT(down.out, HasSubstr("stopping first"));
    EXPECT_THAT(home.wait().out, HasSubstr("home: stopped"));
}

}  // namespace
}  // namespace lockstep
