// A log contains the machine time of each step and its uncertainty, for any clocks of the boards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/analysis_text.hpp"
#include "clients/verification/verification.hpp"
#include "services/record/reading/log_read.hpp"
#include "services/record/reading/log_step.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep::analysis {
namespace {

VirtualOptions boards_apart() {
    VirtualOptions options{.machine = test::example("two-axis")};
    options.machine.timing.time_source = TimeSource::Network;
    options.config_hash = config_hash(options.machine);
    options.network = {.delay_min{20}, .delay_max{300}, .lost = 0.02};
    options.start = Tick{20'000'000};
    options.clocks = test::clocks_apart();
    return options;
}

/// The steps of the log in machine time, in their order.
struct LoggedSteps final : LogListener {
    struct Step {
        Tick machine;
        Ticks error;
    };
    void on_steps(const step_batch_t& message, LogPlace) override {
        const StepBatch batch = in_machine_time(to_batch(message).value());
        for (const StepEdge& step : batch.steps) { axes[message.axis].push_back({step.tick, batch.clock_error}); }
    }
    void on_position(const axis_position_t&, LogPlace) override {}
    void on_run(const run_t&, LogPlace) override {}
    void on_job(const RecordedJob&, LogPlace) override {}
    void on_foreign(std::string_view) override {}
    void on_damage(LogPlace, std::string what) override { ADD_FAILURE() << what; }
    std::map<std::string, std::vector<Step>> axes;
};

/// The true time of every step.
struct TrueSteps final : VirtualObserver {
    explicit TrueSteps(const VirtualOptions& of) : options(of) {}
    void on_step(MotorIndex axis, StepEdge step) override {
        axes[axis].push_back(options.clocks[axis].device.truth(step.tick, options.start));
    }
    VirtualOptions options;
    std::map<std::size_t, std::vector<double>> axes;
};

class MachineTime : public testing::Test {
protected:
    void SetUp() override {
        test::RecordedMachine recorded(options, log);
        recorded.vm().observe(truth);
        recorded.home();
        recorded.advance_ms(2000);
        recorded.begin(test::program_of(recorded.vm().machine(), "G21 G90 F3000\nG1 X60 Y8\nX22 Y50\nX9 Y5\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }

    /// The log with every batch at its true time, which the machine cannot know.
    std::filesystem::path with_true_times() const {
        test::AlteredLog altered(log);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const auto ahead = [&](std::int64_t device) {
                return std::llround(options.clocks[axis].device.truth({device}, options.start)) - device;
            };
            altered.change<step_batch_t>("_" + options.machine.axes[axis].name + "_STEPS", [&](step_batch_t& batch) {
                batch.ahead_first = ahead(batch.first_tick);
                batch.ahead_last =
                    ahead(std::accumulate(batch.delta_ticks.begin(), batch.delta_ticks.end(), batch.first_tick));
                batch.clock_error = 0;
                return true;
            });
        }
        return altered.write(test::test_directory() / "true.lcm");
    }

    VirtualOptions options = boards_apart();
    TrueSteps truth{options};
    const std::filesystem::path log = test::test_directory() / "run.lcm";
};

TEST_F(MachineTime, OfEveryStepIsTrueWithinTheReportedError) {
    LoggedSteps logged;
    ASSERT_TRUE(read_log(log, logged).has_value());
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto& steps = logged.axes[options.machine.axes[axis].name];
        ASSERT_EQ(steps.size(), truth.axes[axis].size());
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const double off = static_cast<double>(steps[i].machine.value) - truth.axes[axis][i];
            ASSERT_LE(std::abs(off), static_cast<double>(steps[i].error.value) + 1)
                << "axis " << axis << ", step " << i;
        }
        EXPECT_LT(steps.back().error, Ticks{120});
    }
}

TEST_F(MachineTime, GivesTheTrueSkewWithinTheReportedError) {
    const auto found = analyze_log(log);
    ASSERT_TRUE(found.has_value()) << found.error();
    ASSERT_EQ(found->step_skew.size(), 1U);
    const PairSkew& skew = found->step_skew.front();
    const PairSkew known = analyze_log(with_true_times())->step_skew.front();
    EXPECT_GT(skew.steps, 5000);
    EXPECT_EQ(skew.steps, known.steps);
    EXPECT_EQ(known.error, Ticks{0});
    const std::vector<std::pair<Ticks, Ticks>> figures = {
        {skew.median, known.median}, {skew.p99, known.p99}, {skew.largest, known.largest}};
    for (const auto& [reported, truly] : figures) {
        EXPECT_LE(std::abs((reported - truly).value), skew.error.value);
        std::printf("reported %lld us, truly %lld us, within %lld us\n", static_cast<long long>(reported.value),
                    static_cast<long long>(truly.value), static_cast<long long>(skew.error.value));
    }
    EXPECT_LT(skew.error, Ticks{300});
    EXPECT_LT(found->largest_distance_mm.value(), 0.05);
    EXPECT_NE(summary(*found).find("its steps are known in machine time within"), std::string::npos);
}

TEST_F(MachineTime, IsVerifiedAndAStepBeyondTheClockErrorIsFound) {
    ASSERT_FALSE(verification::verify_log(log)->difference);
    test::AlteredLog altered(log);
    int seen = 0;
    ASSERT_EQ(altered.change<step_batch_t>("_X_STEPS",
                                           [&](step_batch_t& batch) {
                                               if (batch.position_before < 2000 || ++seen != 10) { return false; }
                                               batch.ahead_first += 1000;
                                               batch.ahead_last += 1000;
                                               return true;
                                           }),
              1);
    const auto findings = verification::verify_log(altered.write(test::test_directory() / "altered.lcm"));
    ASSERT_TRUE(findings->difference);
    EXPECT_NE(findings->difference->text.find("was made at machine time"), std::string::npos)
        << findings->difference->text;
}

/// A message takes up to 4 ms on this network. The estimate of time changes by up to that much between exchanges. So do
/// the intervals of machine time at the ends of messages of steps.
TEST(MachineTimeOfAPoorNetwork, SpeedsAreThoseByTheDevicesClockWhichTheMotorFollows) {
    const std::filesystem::path log = test::test_directory() / "run.lcm";
    VirtualOptions options = boards_apart();
    options.network.delay_max = {4000};
    options.machine.timing.clock_error_limit_us = options.machine.timing.most_clock_error_us();
    const double top = options.machine.axes[0].max_velocity_mm_s * options.machine.axes[0].steps_per_mm * 1e-6;
    {
        test::RecordedMachine recorded(options, log);
        recorded.home();
        recorded.advance_ms(2000);
        recorded.begin(test::program_of(recorded.vm().machine(), "G21 G90\nG0 X160\nX5\nX160\nX5\nX160\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    LoggedSteps logged;
    ASSERT_TRUE(read_log(log, logged).has_value());
    const auto& steps = logged.axes["X"];
    Ticks least{1'000'000};
    for (std::size_t i = 1; i < steps.size(); ++i) { least = std::min(least, steps[i].machine - steps[i - 1].machine); }
    EXPECT_LT(static_cast<double>(least.value), 0.8 / top) << "otherwise this proves nothing";

    const auto found = analyze_log(log);
    ASSERT_TRUE(found.has_value()) << found.error();
    EXPECT_NEAR(found->axes.front()->statistics().peak_steps_per_tick(), top, 0.002 * top);
    EXPECT_EQ(summary(*found).find("above its limit"), std::string::npos) << summary(*found);
}

/// PTP counts time from 1970.
TEST(MachineTimeByPtp, OfAMachineThatCountsFrom1970IsReadAndVerified) {
    const std::filesystem::path log = test::test_directory() / "run.lcm";
    VirtualOptions options{.machine = test::example("two-axis"), .start = Tick{1'795'000'000'000'000}};
    options.machine.timing.time_source = TimeSource::Ptp;
    options.config_hash = config_hash(options.machine);
    {
        test::RecordedMachine recorded(options, log);
        recorded.home();
        recorded.begin(test::program_of(options.machine, "G21 G90 F3000\nG1 X30 Y8\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found.has_value()) << found.error();
    EXPECT_TRUE(found->damages.empty());
    ASSERT_EQ(found->step_skew.size(), 1U);
    EXPECT_EQ(found->step_skew.front().largest, Ticks{0});
    EXPECT_EQ(found->step_skew.front().error, options.machine.clock_error_limit() * 2) << "accepted, and reported";
    EXPECT_FALSE(verification::verify_log(log)->difference);
}

}  // namespace
}  // namespace lockstep::analysis
