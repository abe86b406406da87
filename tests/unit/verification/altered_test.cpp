// Even the smallest change in a log is found and named.
#include <gtest/gtest.h>
#include <unistd.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::AlteredLog;

class Altered : public testing::Test {
protected:
    /// Records a machine that is homed and runs a program, which is held in the middle and resumed.
    static void SetUpTestSuite() {
        const std::string name = "lockstep_original_" + std::to_string(getpid()) + ".lcm";  // tests run side by side
        original = std::filesystem::path(testing::TempDir()) / name;
        test::RecordedMachine recorded(test::example("two-axis"), original);
        recorded.home();
        recorded.begin(
            test::program_of(recorded.vm().machine(), "G21 G90 F3000\nG1 X70 Y8\nX62 Y90\nX9 Y70\nG0 X5 Y5\n"));
        recorded.advance_ms(1000);
        recorded.set_overrides({.feed_percent = 80});
        recorded.advance_ms(500);
        recorded.command(CommandKind::Hold);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }

    static void TearDownTestSuite() { std::filesystem::remove(original); }

    Difference difference() {
        const auto findings = verify_log(log.write(test::test_directory() / "altered.lcm"));
        EXPECT_TRUE(findings.has_value()) << findings.error();
        EXPECT_TRUE(findings && findings->difference);
        return findings && findings->difference ? *findings->difference : Difference{};
    }

    /// The result is not known, for this reason.
    std::string unknown() {
        const auto findings = verify_log(log.write(test::test_directory() / "altered.lcm"));
        EXPECT_TRUE(findings && findings->verdict() == Verdict::Unknown) << to_text(*findings);
        return findings && !findings->unknown.empty() ? findings->unknown.front() : "";
    }

    /// The tenth message with steps of axis X while the program runs: the changes are made there.
    bool is_the_one(const step_batch_t& batch) {
        return batch.axis == "X" && batch.position_before > 800 && ++seen == 10;
    }
    bool is_the_one(const run_t& run) { return run.axis == "Y" && run.epoch != 0 && !run.tail && ++seen == 2; }

    static inline std::filesystem::path original;
    AlteredLog log{original};
    int seen = 0;
};

TEST_F(Altered, NothingWasChanged) {
    const auto findings = verify_log(log.write(test::test_directory() / "altered.lcm"));
    ASSERT_TRUE(findings.has_value());
    EXPECT_FALSE(findings->difference) << to_text(*findings);
    EXPECT_EQ(findings->jobs, 1);
    EXPECT_GT(findings->runs, 40);
}

TEST_F(Altered, OneStepATickLater) {
    std::int64_t tick = 0;
    ASSERT_EQ(log.change<step_batch_t>("_STEPS",
                                       [&](step_batch_t& batch) {
                                           if (!is_the_one(batch)) { return false; }
                                           tick = batch.first_tick + batch.delta_ticks[1] + 1;
                                           batch.delta_ticks[1] += 1;
                                           batch.delta_ticks[2] -= 1;
                                           return true;
                                       }),
              1);
    const Difference found = difference();
    EXPECT_EQ(found.axis, "X");
    EXPECT_EQ(found.tick_expected, Tick{tick - 1});
    EXPECT_EQ(found.tick_seen, Tick{tick});
    EXPECT_NE(found.commanded.find("example.gcode, line 2, epoch "), std::string::npos) << found.commanded;
}

TEST_F(Altered, OneStepTheOtherWay) {
    ASSERT_EQ(log.change<step_batch_t>("_STEPS",
                                       [&](step_batch_t& batch) {
                                           if (!is_the_one(batch)) { return false; }
                                           batch.direction[3] = static_cast<std::int8_t>(-batch.direction[3]);
                                           return true;
                                       }),
              1);
    EXPECT_NE(difference().text.find("the other way"), std::string::npos);
}

TEST_F(Altered, OneStepRemoved) {
    ASSERT_EQ(log.change<step_batch_t>("_STEPS",
                                       [&](step_batch_t& batch) {
                                           if (!is_the_one(batch)) { return false; }
                                           batch.delta_ticks[3] += batch.delta_ticks[2];
                                           batch.delta_ticks.erase(batch.delta_ticks.begin() + 2);
                                           batch.direction.erase(batch.direction.begin() + 2);
                                           --batch.count;
                                           return true;
                                       }),
              1);
    const Difference found = difference();
    EXPECT_EQ(found.axis, "X");
    EXPECT_LT(*found.tick_expected, *found.tick_seen);
}

TEST_F(Altered, TheVeryLastStepRemoved) {
    std::int64_t last = 0;
    log.change<step_batch_t>("_STEPS", [&](step_batch_t& batch) {
        if (batch.axis == "Y") { last = batch.sequence; }
        return false;
    });
    ASSERT_EQ(log.change<step_batch_t>("_STEPS",
                                       [&](step_batch_t& batch) {
                                           if (batch.axis != "Y" || batch.sequence != last) { return false; }
                                           batch.delta_ticks.pop_back();
                                           batch.direction.pop_back();
                                           --batch.count;
                                           return true;
                                       }),
              1);
    const Difference found = difference();
    EXPECT_EQ(found.axis, "Y");
    EXPECT_TRUE(found.tick_expected.has_value());
    EXPECT_FALSE(found.tick_seen.has_value());
}

TEST_F(Altered, OnePositionChanged) {
    ASSERT_EQ(log.change<step_batch_t>(
                  "_STEPS", [&](step_batch_t& batch) { return is_the_one(batch) && ++batch.position_before != 0; }),
              1);
    EXPECT_EQ(difference().axis, "X");
}

TEST_F(Altered, OneMessageOfStepsLost) {
    std::int64_t steps = 0;
    ASSERT_EQ(log.leave_out<step_batch_t>("_STEPS",
                                          [&](const step_batch_t& batch) {
                                              if (!is_the_one(batch)) { return false; }
                                              steps = batch.count;
                                              return true;
                                          }),
              1U);
    const std::string found = unknown();
    EXPECT_NE(found.find("at least " + std::to_string(steps) + " steps missing between tick "), std::string::npos)
        << found;
}

TEST_F(Altered, OneRunLost) {
    ASSERT_EQ(log.leave_out<run_t>("_RUN", [&](const run_t& run) { return is_the_one(run); }), 1U);
    const std::string found = unknown();
    EXPECT_NE(found.find("axis Y: the record of run "), std::string::npos) << found;
}

TEST_F(Altered, BehindLostMessagesADifferenceIsFound) {
    ASSERT_EQ(log.leave_out<run_t>("_RUN", [&](const run_t& run) { return is_the_one(run); }), 1U);
    seen = 0;
    ASSERT_EQ(log.change<step_batch_t>("_STEPS",
                                       [&](step_batch_t& batch) {
                                           const bool is_later = batch.axis == "Y" && batch.position_before > 800 &&
                                                                 batch.count > 2 && ++seen == 40;
                                           if (is_later) { ++batch.delta_ticks[1]; }
                                           return is_later;
                                       }),
              1);
    EXPECT_EQ(difference().axis, "Y");
}

TEST_F(Altered, TheLastRunsLost) {
    ASSERT_GT(log.leave_out<run_t>("_RUN", [&](const run_t& run) { return run.axis == "Y" && run.sequence > 20; }), 1U);
    EXPECT_FALSE(unknown().empty());
}

TEST_F(Altered, AnyFieldOfARun) {
    const std::vector<std::function<void(run_t&)>> changes{
        [](run_t& run) { ++run.velocity.front(); },
        [](run_t& run) { --run.acceleration.back(); },
        [](run_t& run) { ++run.ticks.front(); },
        [](run_t& run) { ++run.start_tick; },
        [](run_t& run) { ++run.start_phase; },
        [](run_t& run) { ++run.start_count; },
        [](run_t& run) { ++run.stop_count; },
        [](run_t& run) { ++run.zero_count; },
        [](run_t& run) { ++run.frame; },
        [](run_t& run) { ++run.epoch; },
        [](run_t& run) { run.tail = 1; },
        [](run_t& run) { run.cut = 1; },
        [](run_t& run) { ++run.incarnation; },
        [](run_t& run) { ++run.sequence; },
        [](run_t& run) { run.epoch = 0; },
    };
    for (std::size_t i = 0; i < changes.size(); ++i) {
        log = AlteredLog(original);
        seen = 0;
        ASSERT_EQ(log.change<run_t>("_RUN",
                                    [&](run_t& run) {
                                        if (!is_the_one(run)) { return false; }
                                        changes[i](run);
                                        return true;
                                    }),
                  1);
        SCOPED_TRACE("change " + std::to_string(i));
        EXPECT_FALSE(difference().text.empty());
    }
}

TEST_F(Altered, AnOverrideByOnePercentOrAFrameEarlier) {
    const std::vector<std::function<void(job_t&)>> changes{[](job_t& job) { ++job.feed_percent; },
                                                           [](job_t& job) { --job.behind_frame; }};
    for (const auto& change : changes) {
        log = AlteredLog(original);
        ASSERT_EQ(log.change<job_t>("_JOB",
                                    [&](job_t& job) {
                                        if (job.event != "override") { return false; }
                                        change(job);
                                        return true;
                                    }),
                  1);
        EXPECT_NE(difference().text.find("frame"), std::string::npos) << difference().text;
    }
}

TEST_F(Altered, AFrameFasterByTheLeastBitNamesThePiece) {
    ASSERT_EQ(log.change<run_t>("_RUN", [&](run_t& run) { return is_the_one(run) && ++run.velocity.front() != 0; }), 1);
    const Difference found = difference();
    EXPECT_NE(found.text.find("frame 2 has piece 1 of "), std::string::npos) << found.text;
}

TEST_F(Altered, AHomingRunFromAnotherPlace) {
    ASSERT_EQ(log.change<run_t>("_RUN",
                                [&](run_t& run) {
                                    return run.epoch == 0 && run.axis == "X" && run.sequence == 1 &&
                                           ++run.start_phase != 0;
                                }),
              1);
    EXPECT_EQ(difference().text, "axis X: run 1, frame 2 of the axis's own move does not continue the frame before it");
}

TEST_F(Altered, ProgramChanged) {
    ASSERT_EQ(log.change<job_t>("_JOB",
                                [&](job_t& job) {
                                    const auto at = job.program.find("62");
                                    if (at == std::string::npos) { return false; }
                                    job.program.replace(at, 2, "63");
                                    return true;
                                }),
              1);
    EXPECT_NE(difference().text.find("planned"), std::string::npos);
}

TEST_F(Altered, TheConfigurationAnother) {
    ASSERT_GE(log.change<job_t>("_JOB",
                                [&](job_t& job) {
                                    const auto at = job.config.find("max_accel_mm_s2: 1500");
                                    if (at == std::string::npos) { return false; }
                                    job.config.replace(at, 21, "max_accel_mm_s2: 1501");
                                    return true;
                                }),
              1);
    (void)difference();
}

TEST_F(Altered, AJobWithWildNumbers) {
    ASSERT_GE(log.change<job_t>("_JOB",
                                [&](job_t& job) {
                                    for (std::int64_t& count : job.start_count) { count = INT64_MIN; }
                                    return !job.start_count.empty();
                                }),
              1);
    EXPECT_FALSE(unknown().empty());
}

TEST_F(Altered, AnyRecordOfAJobLost) {
    for (std::int64_t place = 2; place < 6; ++place) {  // after homing: begun, two epochs, ended
        log = AlteredLog(original);
        std::int64_t number = 0;
        ASSERT_EQ(log.leave_out<job_t>("_JOB", [&](const job_t&) { return number++ == place; }), 1U);
        SCOPED_TRACE("record " + std::to_string(place));
        EXPECT_FALSE(unknown().empty());
    }
}

TEST_F(Altered, CutShortItReportsHowFarItWasCompared) {
    const std::size_t whole = log.events().size();
    for (const std::size_t part : {whole / 2, whole * 2 / 3, whole - whole / 10}) {
        log = AlteredLog(original);
        log.cut_to(part);
        const auto findings = verify_log(log.write(test::test_directory() / "altered.lcm"));
        ASSERT_TRUE(findings.has_value());
        EXPECT_FALSE(findings->is_exact());
        EXPECT_FALSE(findings->difference) << to_text(*findings);
        EXPECT_NE(to_text(*findings).find("unknown: the log ends before job "), std::string::npos);
        EXPECT_NE(to_text(*findings).find("are compared"), std::string::npos);
    }
}

TEST_F(Altered, MessagesThatOvertookEachOtherAreNoDifference) {
    for (std::size_t i = 0; i + 1 < log.events().size(); i += 2) {
        auto& events = log.events();
        if (events[i].channel != events[i + 1].channel) { std::swap(events[i], events[i + 1]); }
    }
    const auto findings = verify_log(log.write(test::test_directory() / "altered.lcm"));
    ASSERT_TRUE(findings.has_value());
    EXPECT_FALSE(findings->difference) << to_text(*findings);
}

TEST_F(Altered, MessagesThatCameTwiceAreNoDifference) {
    std::vector<AlteredLog::Event> twice;
    for (const auto& event : log.events()) {
        twice.push_back(event);
        twice.push_back(event);
    }
    log.events() = twice;
    const auto findings = verify_log(log.write(test::test_directory() / "altered.lcm"));
    ASSERT_TRUE(findings.has_value());
    EXPECT_FALSE(findings->difference) << to_text(*findings);
}

TEST_F(Altered, AFileThatIsNotALogIsRefused) {
    EXPECT_FALSE(verify_log("deploy/examples/plate.gcode"));
    EXPECT_FALSE(verify_log("/nowhere.lcm"));
    log.leave_out<step_batch_t>("_STEPS", [](const step_batch_t&) { return true; });
    log.leave_out<run_t>("_RUN", [](const run_t&) { return true; });
    log.leave_out<job_t>("_JOB", [](const job_t&) { return true; });
    EXPECT_FALSE(verify_log(log.write(test::test_directory() / "positions.lcm")));
}

}  // namespace
}  // namespace lockstep::verification
