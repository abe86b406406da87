// The skew between axes is measured from the record alone.
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/report.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::analysis {
namespace {

class Skew : public testing::Test {
protected:
    void SetUp() override {
        test::RecordedMachine recorded(test::example("two-axis"), original);
        recorded.home();
        recorded.begin(test::program_of(recorded.vm().machine(), "G21 G90 F3000\nG1 X30 Y8\nX22 Y40\nX9 Y5\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }

    /// The skew between the machine's two axes.
    static PairSkew skew_in(const std::filesystem::path& log) {
        const auto found = analyze_log(log);
        EXPECT_TRUE(found.has_value());
        EXPECT_TRUE(found && found->step_skew.size() == 1);
        return found && !found->step_skew.empty() ? found->step_skew.front() : PairSkew{};
    }

    const std::filesystem::path original = test::test_directory() / "original.lcm";
};

TEST_F(Skew, IsZeroIfOneClockDrivesAllDevices) {
    const PairSkew skew = skew_in(original);
    EXPECT_EQ(skew.first, "X");
    EXPECT_EQ(skew.second, "Y");
    EXPECT_GT(skew.steps, 4000);
    EXPECT_EQ(skew.largest, Ticks{0});
}

TEST_F(Skew, IsThreeMicrosecondsIfOneAxisIsThreeMicrosecondsLate) {
    test::AlteredLog log(original);
    ASSERT_GT(log.change<step_batch_t>(
                  "_Y_STEPS", [](step_batch_t& batch) { return batch.count > 0 && (batch.first_tick += 3) > 0; }),
              0);
    const auto altered = log.write(test::test_directory() / "altered.lcm");
    const PairSkew skew = skew_in(altered);
    EXPECT_EQ(skew.median, Ticks{3});
    EXPECT_EQ(skew.p99, Ticks{3});
    EXPECT_EQ(skew.largest, Ticks{3});
    const auto report = to_report(*analyze_log(altered));
    ASSERT_EQ(report.step_skew_between_axes_size(), 1);
    EXPECT_DOUBLE_EQ(report.step_skew_between_axes(0).max_us(), 3);
    EXPECT_NE(summary(*analyze_log(altered)).find("step skew between axes"), std::string::npos);
}

TEST_F(Skew, IsTheLargestOfAll) {
    test::AlteredLog log(original);
    int seen = 0;
    ASSERT_EQ(log.change<step_batch_t>("_X_STEPS",
                                       [&](step_batch_t& batch) {
                                           if (batch.position_before < 800 || ++seen != 10) { return false; }
                                           batch.delta_ticks[1] -= 2;  // one step early
                                           batch.delta_ticks[2] += 2;
                                           return true;
                                       }),
              1);
    const PairSkew skew = skew_in(log.write(test::test_directory() / "altered.lcm"));
    EXPECT_EQ(skew.p99, Ticks{0});
    EXPECT_EQ(skew.largest, Ticks{2});
}

TEST_F(Skew, IsNotInventedWhereStepsAreMissing) {
    test::AlteredLog log(original);
    int seen = 0;
    ASSERT_EQ(log.leave_out<step_batch_t>(
                  "_X_STEPS", [&](const step_batch_t& batch) { return batch.position_before > 800 && ++seen == 10; }),
              1U);
    const PairSkew skew = skew_in(log.write(test::test_directory() / "altered.lcm"));
    EXPECT_GT(skew.steps, 2000);
    EXPECT_EQ(skew.largest, Ticks{0});
}

}  // namespace
}  // namespace lockstep::analysis
