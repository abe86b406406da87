// A log that ends badly, because an axis or the coordinator of a job was killed in motion. The run is still as planned,
// and a wrong step is still found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::AlteredLog;
using test::kCoordinator;
using test::kY;
using test::RecordedMachine;
using testing::HasSubstr;

constexpr std::string_view kLine = "G21 G90 F3000\nG1 X80 Y90\nX9 Y70\n";

class EndedLog : public testing::Test {
protected:
    std::filesystem::path path() const { return test::test_directory() / "run.lcm"; }

    /// A process is killed in the middle of a job; another replaces it after a while. The log ends two seconds
    /// after the kill.
    void record(VirtualOptions options, std::size_t killed, std::int64_t into_ms, std::int64_t dead_ms) {
        RecordedMachine recorded(options, path());
        recorded.home();
        recorded.begin(test::program_of(options.machine, kLine));
        recorded.advance_ms(into_ms);
        recorded.vm().schedule({.kind = VirtualFault::Kind::Crash,
                                .process = killed,
                                .at = recorded.vm().now(),
                                .lasts = Ticks{dead_ms * 1000}});
        recorded.advance_ms(2000);
    }
    void record(std::size_t killed, std::int64_t into_ms, std::int64_t dead_ms) {
        const MachineSetup machine = test::example("two-axis");
        record({.machine = machine, .config_hash = config_hash(machine)}, killed, into_ms, dead_ms);
    }
    Findings verified(const std::filesystem::path& log) const {
        const auto findings = verify_log(log);
        EXPECT_TRUE(findings.has_value()) << findings.error();
        return findings.value_or(Findings{});
    }
    /// The log with one step a tick later, in the last message of the axis with enough steps.
    std::filesystem::path with_a_step_later(const std::string& axis, std::int64_t& tick) const {
        AlteredLog log(path());
        const auto is_fit = [&](const step_batch_t& batch) { return batch.axis == axis && batch.count > 3; };
        int fit = 0;
        log.change<step_batch_t>("_STEPS", [&](step_batch_t& batch) { return is_fit(batch) && ++fit == 0; });
        log.change<step_batch_t>("_STEPS", [&](step_batch_t& batch) {
            if (!is_fit(batch) || --fit > 0) { return false; }
            tick = batch.first_tick + batch.delta_ticks[1] + 1;
            batch.delta_ticks[1] += 1;
            batch.delta_ticks[2] -= 1;
            return true;
        });
        return log.write(test::test_directory() / "altered.lcm");
    }
    void expect_exact_and_alterations_found(const std::string& axis, const std::string& note) const {
        const Findings found = verified(path());
        EXPECT_FALSE(found.difference) << to_text(found);
        EXPECT_THAT(to_text(found), HasSubstr(note));
        std::int64_t tick = 0;
        const Findings altered = verified(with_a_step_later(axis, tick));
        ASSERT_TRUE(altered.difference) << to_text(altered);
        EXPECT_EQ(altered.difference->axis, axis);
        EXPECT_EQ(altered.difference->tick_seen, Tick{tick}) << to_text(altered);
        EXPECT_EQ(altered.difference->tick_expected, Tick{tick - 1}) << to_text(altered);
    }
};

class KilledInMotion : public EndedLog, public testing::WithParamInterface<int> {};

TEST_P(KilledInMotion, AnAxisWithoutSuccessor) {
    record(kY, GetParam(), 10'000);
    expect_exact_and_alterations_found("Y", "its process ended; they are as planned: ");
}

TEST_P(KilledInMotion, AnAxisWhoseSuccessorFindsItsStepsInTheDevice) {
    for (const int dead_ms : {50, 400, 1500}) {
        SCOPED_TRACE(std::to_string(dead_ms) + " ms");
        record(kY, GetParam(), dead_ms);
        expect_exact_and_alterations_found("Y", "then its tail");
    }
}

TEST_P(KilledInMotion, ACoordinatorWithoutSuccessor) {
    record(kCoordinator, GetParam(), 10'000);
    expect_exact_and_alterations_found("X", "has no end in the log; the axes are at rest; what was run of it is");
}

TEST_P(KilledInMotion, AnAxisOfBoardsWithClocksOfTheirOwn) {
    MachineSetup machine = test::example("two-axis");
    machine.timing.time_source = TimeSource::Network;
    record({.machine = machine,
            .config_hash = config_hash(machine),
            .start = Tick{20'000'000},
            .clocks = {{.process = {.offset = {5'000'000}, .ppm = 90}, .device = {.offset = {9'000'000}, .ppm = -70}},
                       {.process = {.offset = {-4'000'000}, .ppm = -60}, .device = {.offset = {123}, .ppm = 100}}}},
           kY, GetParam(), 400);
    const Findings found = verified(path());
    EXPECT_FALSE(found.difference) << to_text(found);
    EXPECT_THAT(to_text(found), HasSubstr("they are as planned: "));
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, KilledInMotion, testing::Values(450, 555, 760, 900, 1111));

TEST_F(EndedLog, ACoordinatorOfAMachineThatIsHeld) {
    {
        const MachineSetup machine = test::example("two-axis");
        RecordedMachine recorded(machine, path());
        recorded.home();
        recorded.begin(test::program_of(machine, kLine));
        recorded.advance_ms(700);
        recorded.command(CommandKind::Hold);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
        recorded.advance_ms(1000);
    }
    const Findings found = verified(path());
    EXPECT_FALSE(found.difference) << to_text(found);
    EXPECT_THAT(to_text(found), HasSubstr("has no end in the log; the axes are at rest"));
}

TEST_F(EndedLog, ALivingAxisThatLacksItsLastRunIsUnknown) {
    record(kCoordinator, 700, 10'000);
    AlteredLog log(path());
    std::int64_t from = 0;
    log.leave_out<run_t>("_RUN", [&](const run_t& run) {
        if (run.axis == "Y" && run.tail != 0 && run.epoch != 0) { from = run.start_tick; }
        return run.axis == "Y" && run.tail != 0 && run.epoch != 0;
    });
    ASSERT_GT(from, 0);
    log.leave_out<step_batch_t>(
        "_STEPS", [&](const step_batch_t& batch) { return batch.axis == "Y" && batch.first_tick >= from; });
    const Findings found = verified(log.write(test::test_directory() / "altered.lcm"));
    EXPECT_EQ(found.verdict(), Verdict::Unknown) << to_text(found);
    EXPECT_THAT(to_text(found), HasSubstr("axis Y has nothing in the log after frame"));
}

TEST_F(EndedLog, CutShortInMotionItIsIncomplete) {
    record(kCoordinator, 700, 10'000);
    AlteredLog log(path());
    std::size_t last_run = 0;
    for (std::size_t i = 0; i < log.events().size(); ++i) {
        if (log.events()[i].channel.ends_with("_RUN")) { last_run = i; }
    }
    log.cut_to(last_run);
    const Findings found = verified(log.write(test::test_directory() / "altered.lcm"));
    EXPECT_FALSE(found.difference) << to_text(found);
    EXPECT_FALSE(found.is_exact());
    EXPECT_THAT(to_text(found), HasSubstr("unknown: the log ends before job 2"));
}

}  // namespace
}  // namespace lockstep::verification
