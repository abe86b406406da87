// Lines that are given one by one keep their modes and parameters.
#include "clients/web/program/mdi_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;

class Mdi : public testing::Test {
protected:
    /// Gives the line to a machine that accepts it.
    std::optional<ReadyProgram> give(const std::string& line) {
        auto read = mdi.read(line, real_start(snapshot, two_axes()).value());
        EXPECT_TRUE(read) << line;
        mdi.answer(true);
        return read ? *std::move(read) : std::nullopt;
    }
    std::vector<std::string> words() const { return mdi.modes().words; }

    Snapshot snapshot = snapshot_at_rest();
    MdiSession mdi{two_axes()};
};

TEST_F(Mdi, AWrongLineIsRefusedWithItsColumn) {
    const auto read = mdi.read("G0 X9999", real_start(snapshot, two_axes()).value());
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().status, 422);
    EXPECT_EQ(read.error().errors[0].column, 4);
    EXPECT_TRUE(mdi.read("G0 X9", real_start(snapshot, two_axes()).value())) << "it leaves nothing behind";
}

TEST_F(Mdi, ALineThatMovesNothingNeedsNoJob) {
    EXPECT_FALSE(give("#1=50 G91 G55 F600"));
    EXPECT_THAT(words(), AllOf(Contains("G91"), Contains("G55"), Contains("F600")));
    EXPECT_EQ(mdi.modes().system, 1U);
    const auto offsets = give("G10 L2 P2 X10");
    ASSERT_TRUE(offsets) << "the machine stores them";
    EXPECT_EQ(offsets->values.after->systems[1].origin[0], 10);
    EXPECT_TRUE(give("G90 G0 X[#1+1]")) << "the parameter holds";
}

TEST_F(Mdi, ALineThatTheMachineRefusesLeavesNothing) {
    ASSERT_TRUE(mdi.read("G91 G0 X1", real_start(snapshot, two_axes()).value()));
    mdi.answer(false);
    EXPECT_THAT(words(), Contains("G90"));
}

TEST_F(Mdi, TheNextLineWaitsForTheAnswerToTheOneBefore) {
    ASSERT_TRUE(mdi.read("G91", real_start(snapshot, two_axes()).value()));
    const auto second = mdi.read("G0 X1", real_start(snapshot, two_axes()).value());
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().status, 409);
}

TEST_F(Mdi, ModesEndWithM2AProgramAFaultAndAReset) {
    const std::vector<std::string> begin = words();
    EXPECT_THAT(begin, ElementsAre("G80", "G54", "G17", "G21", "G90", "G94", "M5", "M9", "T0", "F0", "S0"));
    const auto fault = [&] {
        snapshot.machine->value.phase = MachinePhase::Fault;
        mdi.see(snapshot);
        snapshot.machine->value.phase = MachinePhase::Idle;
    };
    const std::vector<std::function<void()>> ends{[&] { give("M2"); }, [&] { give("M30"); }, [&] { mdi.end_program(); },
                                                  fault, [&] { mdi.reset(); }};
    for (const auto& end : ends) {
        give("G91 G55 F600");
        EXPECT_NE(words(), begin);
        end();
        EXPECT_EQ(words(), begin);
    }
}

TEST_F(Mdi, AResetDropsTheLineThatWaits) {
    ASSERT_TRUE(mdi.read("G91 G0 X1", real_start(snapshot, two_axes()).value()));
    mdi.reset();
    mdi.answer(true);
    EXPECT_THAT(words(), Contains("G90"));
}

TEST_F(Mdi, SpindleAndCoolantAreAsTheMachineReports) {
    snapshot.machine->value.devices = {.spindle = SpindleDirection::Forward, .flood = true};
    mdi.see(snapshot);
    EXPECT_THAT(words(), AllOf(Contains("M3"), Contains("M8")));
    snapshot.machine->value.devices = {};
    mdi.see(snapshot);
    EXPECT_THAT(words(), AllOf(Contains("M5"), Contains("M9")));
}

TEST_F(Mdi, TheOldestLinesAreForgotten) {
    for (std::size_t k = 0; k <= MdiSession::kMostLines; ++k) { mdi.note("G0 X" + std::to_string(k), k % 2 == 0); }
    const auto lines = mdi.lines();
    EXPECT_EQ(lines.size(), MdiSession::kMostLines);
    EXPECT_EQ(lines.front(), std::pair(std::string("G0 X1"), false));
    EXPECT_EQ(lines.back(), std::pair(std::string("G0 X100"), true));
}

TEST(MdiProbe, TheNextLineKnowsWhereTheProbeTouchedAndWhereTheAxesRest) {
    MachineSetup machine = two_axes();
    machine.inputs = {{.name = "plate", .motor = machine.axes[0].name, .use = InputUse::Probe, .number = 0}};
    Snapshot snapshot = snapshot_at_rest();
    MdiSession mdi(machine);
    const std::vector<double> from_mm = real_start(snapshot, machine).value().place_mm;
    const std::string line = "G91 G38.2 X4 F60";
    ASSERT_TRUE(mdi.read(line, real_start(snapshot, machine).value()));
    mdi.answer(true, 7);

    ProbeResult probe{.job = 7, .input = 0, .tick = {}, .places_mm = {}};
    for (const double mm : from_mm) { probe.places_mm.append(mm); }
    probe.places_mm[0] += 2;
    snapshot.machine->value.probe = probe;
    const double rest_mm = from_mm[0] + 3;
    snapshot.axes[0].state->value.position = Position::steps(to_steps(machine.axes[0], rest_mm));
    mdi.see(snapshot);
    const auto next = mdi.read("G0 X[#5061-#5420]", real_start(snapshot, machine).value());
    ASSERT_TRUE(next && *next);
    EXPECT_NEAR((*next)->head.start_mm[0], rest_mm, 0.01);
    ProgramSender sender(7, 1, 42, (*next)->head, (*next)->values);
    (*next)->feed(sender);
    EXPECT_TRUE(sender.has_unsent()) << "it moves back to the touch";
}

TEST(MdiProbe, AResultOfAnotherMachineIsNotTaken) {
    MachineSetup machine = two_axes();
    machine.inputs = {{.name = "plate", .motor = machine.axes[0].name, .use = InputUse::Probe, .number = 0}};
    Snapshot snapshot = snapshot_at_rest();
    MdiSession mdi(machine);
    ASSERT_TRUE(mdi.read("G91 G38.2 X4 F60", real_start(snapshot, machine).value()));
    mdi.answer(true, 7);
    snapshot.machine->value.probe = ProbeResult{.job = 7, .input = 0, .tick = {}, .places_mm = {}};
    mdi.see(snapshot);
    EXPECT_TRUE(mdi.read("G0 X1", real_start(snapshot, machine).value())) << "the session begins again";
}

}  // namespace
}  // namespace lockstep::web
