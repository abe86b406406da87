// The pulses of a move by Lai's method, with steady periods one by one and at once.
#include "core/coordinator/path/lai_periods.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "core/motion/moves.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kPeriodsTick_ns = 1000;
const std::vector<double> kStepsPerMm{80, 80, 400};

std::vector<AxisLimits> limits() {
    AxisLimits axis{.start_velocity = 2e-3, .max_velocity = 0.02, .max_acceleration = 2e-7, .max_deceleration = 2e-7};
    axis.min_steps = -(1LL << 31);
    axis.max_steps = 1LL << 31;
    return {axis, axis, axis};
}

/// The pulses that one axis makes in each period.
struct Made {
    std::int64_t steps = 0;
    std::int64_t least = 1'000'000;  // in the periods that pass() may make at once
    std::int64_t greatest = 0;
    bool operator==(const Made&) const = default;
};

struct PulseRun {
    std::int64_t periods = 0;
    int calls = 0;
    std::vector<Made> axes = std::vector<Made>(3);

    void add(const LaiPeriods& at, std::int64_t count) {
        periods += count;
        ++calls;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const std::int64_t pulses = std::abs(at.pulses()[i]);
            axes[i].steps += at.pulses()[i];
            axes[i].least = std::min(axes[i].least, pulses / count);
            axes[i].greatest = std::max(axes[i].greatest, (pulses + count - 1) / count);
        }
    }
};

PulseRun run_pulses(const PathMove& move, bool at_once) {
    const auto axes = limits();
    LaiPeriods periods(axes, kPeriodsTick_ns, LaiFollowing::OnTheLine);
    periods.begin(move);
    PulseRun run;
    while (periods.next()) {
        run.add(periods, 1);
        const std::int64_t many = periods.steady();
        if (!at_once || many < 2) { continue; }
        periods.pass(many);
        run.add(periods, many);
    }
    return run;
}

PathMove move_to(const AxisCounts& to) { return make_move({0, 0, 0}, to, limits(), kStepsPerMm, std::nullopt); }

TEST(LaiPeriods, MakesTheSamePulsesOneByOneAndAtOnce) {
    std::mt19937_64 random(1);
    for (int k = 0; k < 500; ++k) {
        const std::int64_t most = 1LL << (1 + random() % 18);
        std::uniform_int_distribution<std::int64_t> steps(-most, most);
        const AxisCounts to{steps(random), steps(random), steps(random)};
        const PathMove move = move_to(to);
        if (move.lead == 0) { continue; }
        SCOPED_TRACE(testing::Message() << to[0] << " " << to[1] << " " << to[2]);
        const PulseRun single = run_pulses(move, false);
        const PulseRun quick = run_pulses(move, true);
        EXPECT_EQ(quick.periods, single.periods);
        EXPECT_EQ(quick.axes, single.axes);
        for (std::size_t i = 0; i < 3; ++i) { EXPECT_EQ(single.axes[i].steps, to[i]); }
    }
}

TEST(LaiPeriods, CostsNoMoreForAMoveOfDays) {
    const PulseRun of_seconds = run_pulses(move_to({100'000, 30'000, 7}), true);
    const PulseRun of_days = run_pulses(move_to({1 << 30, 1 << 29, 77}), true);
    EXPECT_GT(of_days.periods, 5'000 * of_seconds.periods);
    EXPECT_LE(of_days.calls, of_seconds.calls + 2);
}

}  // namespace
}  // namespace lockstep
