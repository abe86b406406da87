// Jogs by the command, with real processes: by a distance, by keys, with a client that is killed, and their records.
#include <gmock/gmock.h>
#include <signal.h>

#include <thread>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/cli/terminal.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class JogOfARealMachine : public OwnMachine {
protected:
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up_and_home();
        record();
    }
    std::int64_t steps_of_x() const { return status().axes(0).position_steps(); }
    bool moves_beyond(std::int64_t steps) const {
        return eventually([&] { return steps_of_x() > steps; });
    }
};

TEST_F(JogOfARealMachine, GoesTheDistanceAskedForAndIsOnRecord) {
    const std::int64_t before = steps_of_x();
    const Ran there = run_lockstep({"jog", "X+", "--distance", "12.5", "--speed", "40", "--json"});
    ASSERT_EQ(there.code, 0) << there.out << there.err;
    const auto report = there.json<proto::RunReport>();
    EXPECT_EQ(report.kind(), "jog");
    EXPECT_EQ(report.outcome(), "done");
    EXPECT_EQ(report.final_positions(0).position_steps(), before + 1000);
    const Ran both = run_lockstep({"jog", "X-", "Y+", "--distance", "2"});
    EXPECT_EQ(both.code, 0) << both.out << both.err;
    EXPECT_THAT(both.out, HasSubstr("jog X- Y+: done; at X"));
    EXPECT_EQ(steps_of_x(), before + 1000 - 160);
    EXPECT_EQ(status().phase(), "Idle");
    expect_verified();
}

TEST_F(JogOfARealMachine, ThatIsSlowerThanAStepInMinutesStopsAndItsRecordIsExact) {
    const Ran refused = run_lockstep({"jog", "X+", "--speed", "1e-320"});
    EXPECT_EQ(refused.code, 2) << refused.out << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("from 1e-05 mm/s"));
    for (const Words& words :
         {Words{"jog", "X+", "--speed", "0.0001"}, Words{"move", "--own", "Y=-48.95", "--in", "600"}}) {
        ChildProcess client(LOCKSTEP_COMMAND, words);
        ASSERT_TRUE(eventually([&] { return status().phase() != "Idle"; }));
        std::this_thread::sleep_for(std::chrono::milliseconds{300});
        const Ran stop = run_lockstep({"stop"});
        EXPECT_EQ(stop.code, 0) << stop.out << stop.err;
        EXPECT_TRUE(becomes("Idle"));
        (void)client.wait();
    }
    EXPECT_TRUE(status().axes(0).homed());
    EXPECT_EQ(run_lockstep({"jog", "X+", "--distance", "0.5"}).code, 0);
    EXPECT_EQ(run_lockstep({"move", "--own", "X=20"}).code, 0);
    expect_verified();
}

TEST_F(JogOfARealMachine, RestsWhenItsClientIsKilledAndItsRecordIsExact) {
    const std::int64_t before = steps_of_x();
    ChildProcess client(LOCKSTEP_COMMAND, {"jog", "X+", "--speed", "10"});
    ASSERT_TRUE(moves_beyond(before));
    EXPECT_EQ(status().phase(), "Jogging");
    const Ran other = run_lockstep({"jog", "X-", "--json"});
    EXPECT_EQ(other.json<proto::RunReport>().fault().name(), "busy") << other.out;
    client.signal(SIGKILL);
    (void)client.wait();
    EXPECT_TRUE(becomes("Idle"));
    const std::int64_t rests_at = steps_of_x();
    EXPECT_EQ(run_lockstep({"jog", "X-", "--distance", "0.5"}).code, 0);
    EXPECT_EQ(steps_of_x(), rests_at - 40) << "nothing moved it meanwhile, and its position is known";
    expect_verified();
}

TEST_F(JogOfARealMachine, IsReleasedByCtrlC) {
    const std::int64_t before = steps_of_x();
    ChildProcess client(LOCKSTEP_COMMAND, {"jog", "X+", "--json"});
    ASSERT_TRUE(moves_beyond(before));
    client.signal(SIGINT);
    const Ran ended = client.wait();
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.json<proto::RunReport>().outcome(), "released");
    EXPECT_EQ(ended.json<proto::RunReport>().final_positions(0).position_steps(), steps_of_x());
    EXPECT_EQ(status().phase(), "Idle");
}

/// Types like a terminal that repeats a held key.
TEST_F(JogOfARealMachine, ByKeysMovesWhileTheKeyIsRepeated) {
    using namespace std::chrono_literals;
    const std::int64_t before = steps_of_x();
    Terminal terminal("jog");
    ASSERT_TRUE(terminal.shows("left, right"));
    std::int64_t now = before;
    ASSERT_TRUE(eventually([&] {
        for (int i = 0; i < 10; ++i) {
            terminal.type("\x1b[C");
            std::this_thread::sleep_for(30ms);
        }
        now = steps_of_x();
        return now > before + 80;
    }));
    EXPECT_TRUE(becomes("Idle")) << "after the last repetition";
    const std::int64_t rests_at = steps_of_x();
    terminal.type("\x1b[D");
    EXPECT_TRUE(eventually([&] { return steps_of_x() < rests_at; }));
    terminal.type("q");
    EXPECT_EQ(terminal.wait(), 0);
    EXPECT_TRUE(terminal.echoes());
}

TEST_F(JogOfARealMachine, ByKeysQuitsAfterAStallAndDoesNotMoveByOldKeys) {
    using namespace std::chrono_literals;
    Terminal terminal("jog");
    ASSERT_TRUE(terminal.shows("left, right"));
    const std::int64_t before = steps_of_x();
    terminal.type_while_stopped("\x1b[Cq", 500ms);
    EXPECT_EQ(terminal.wait(), 0);
    EXPECT_EQ(steps_of_x(), before);
}

TEST_F(JogOfARealMachine, IsRefusedWithTheReason) {
    EXPECT_EQ(run_lockstep({"jog"}).code, 2) << "keys need a terminal";
    EXPECT_EQ(run_lockstep({"jog", "X"}).code, 2);
    EXPECT_EQ(run_lockstep({"jog", "Q+"}).code, 2);
    EXPECT_EQ(run_lockstep({"jog", "X+", "--speed", "100000"}).code, 2);
    ASSERT_EQ(run_lockstep({"estop"}).code, 0);
    const Ran refused = run_lockstep({"jog", "X+"});
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("refused: the machine is in Fault"));
}

}  // namespace
}  // namespace lockstep
