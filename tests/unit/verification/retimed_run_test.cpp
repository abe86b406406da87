// A run on the device's own clock is the planned one within half a tick at the end of each piece, and no further.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "clients/verification/jobs/run_difference.hpp"
#include "core/axis/device/retime.hpp"

namespace lockstep::verification {
namespace {

class RetimedRun : public testing::Test {
protected:
    std::int64_t between(std::int64_t least, std::int64_t most) {
        return std::uniform_int_distribution(least, most)(random);
    }
    double part(double most) { return std::uniform_real_distribution(-most, most)(random); }

    /// Pieces of any length, many of a single tick, with jumps and turns between them.
    analysis::Run any_plan() {
        analysis::Run plan{
            .epoch = 3, .frame = 1, .start = Tick{between(0, 1'000'000'000)}, .from = Position::steps(7)};
        for (std::int64_t n = between(2, 20); n > 0; --n) {
            const std::int64_t ticks = between(0, 2) == 0 ? between(1, 3) : between(1, 50'000);
            const std::int64_t fastest = std::int64_t{1} << between(20, 60);
            const std::int64_t gain = fastest / 4 / ticks;
            plan.pieces.push_back({{ticks}, {between(-fastest, fastest)}, {between(-gain, gain)}});
        }
        return plan;
    }
    /// The run that an axis gives its device. The device's clock is up to 700 ppm off, and its rate changes.
    analysis::Run on_another_clock(const analysis::Run& plan) {
        analysis::Run run = plan;
        run.start = Tick{between(0, 1'000'000'000)};
        run.ahead = plan.start - run.start;
        const auto ticks = static_cast<double>(plan.ticks().value);
        const auto least = static_cast<std::int64_t>(plan.pieces.size());
        const Ticks lasts{std::max(least, static_cast<std::int64_t>(std::llround(ticks * (1 + part(700e-6)))))};
        StaticVector<Piece, kMaxBodyPieces + 1> pieces;
        for (const Piece& piece : plan.pieces) {
            run.commanded_ticks.push_back(piece.ticks);
            (void)pieces.push_back(piece);
        }
        EXPECT_TRUE(retime(pieces, {run.start, run.start + lasts, part(500e-6)}));
        run.pieces.assign(pieces.begin(), pieces.end());
        return run;
    }

    std::mt19937_64 random{1};
};

TEST_F(RetimedRun, EndsEachPieceWithinHalfATick) {
    for (int i = 0; i < 20'000; ++i) {
        const analysis::Run plan = any_plan();
        const analysis::Run run = on_another_clock(plan);
        const auto found = compare_retimed(plan, run, run.start);
        ASSERT_FALSE(found) << "plan " << i << ": " << found->text;
    }
}

/// One piece covers more and the next one less, so that the run still ends at its place.
TEST_F(RetimedRun, PieceThatEndsATickFurtherIsFound) {
    constexpr std::int64_t kTicks = 1000;
    const auto speed = std::int64_t{1} << 50;
    for (int i = 0; i < 1000; ++i) {
        analysis::Run plan{.epoch = 3, .frame = 1, .start = Tick{5000}, .from = Position::steps(0)};
        for (int n = 0; n < 4; ++n) { plan.pieces.push_back({{kTicks}, {speed}, {}}); }
        analysis::Run run = on_another_clock(plan);
        ASSERT_FALSE(compare_retimed(plan, run, run.start));
        const auto altered = static_cast<std::size_t>(between(0, 2));
        const std::int64_t further = (between(0, 1) == 0 ? speed : -speed) / run.pieces[altered].ticks.value;
        run.pieces[altered].velocity.raw += further * 11 / 10;
        run.pieces[altered + 1].velocity.raw -= further * 11 / 10;
        EXPECT_TRUE(compare_retimed(plan, run, run.start)) << i;
    }
}

}  // namespace
}  // namespace lockstep::verification
