// The distance of each move from its line is measured from steps in the order of time, and from late steps.
#include "clients/analysis/moves/job_moves.hpp"

#include <gtest/gtest.h>

#include "services/record/reading/recorded_program.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

/// The path is 1 mm on X and Y together, then two moves of 1 mm on X.
class LateSteps : public testing::Test {
protected:
    void move(std::size_t axis, std::int64_t first, std::int64_t from_count, std::int64_t steps) {
        for (std::int64_t i = 0; i < steps; ++i) { step(axis, first + i * 100, from_count + i + 1); }
    }
    void step(std::size_t axis, std::int64_t tick, std::int64_t count) {
        job.take(MotorIndex{axis}, MeasuredStep{.tick = {tick}, .count = count, .direction = 1});
    }
    void both(std::int64_t first, std::int64_t from_count, std::int64_t steps) {
        for (std::int64_t i = 0; i < steps; ++i) {
            step(0, first + i * 100, from_count + i + 1);
            step(1, first + i * 100 + 1, from_count + i + 1);
        }
    }

    static AskedPath asked() {
        const auto program =
            std::make_shared<const RecordedProgram>(test::path_through({{0, 0}, {1, 1}, {2, 1}, {3, 1}}));
        return AskedPath::of(test::two_axes(), program->head(), program).value();
    }

    JobMoves job{asked(), true};
};

TEST_F(LateSteps, InTheOrderOfTimeEachMoveHasItsDistance) {
    both(1000, 0, 100);
    move(0, 20'000, 100, 200);
    EXPECT_LT(job.move(0).largest_distance_mm.value(), 0.01);
    EXPECT_LT(job.move(1).largest_distance_mm.value(), 0.01);
    EXPECT_EQ(job.moves_without_distance(), 0);
}

TEST_F(LateSteps, LeaveOnlyTheDistancesOfTheMovesMeanwhileUnknown) {
    both(1000, 0, 50);
    move(0, 6000, 50, 150);  // into the second move
    move(1, 6001, 50, 50);   // still in the first move
    move(0, 40'000, 200, 100);
    EXPECT_FALSE(job.move(0).largest_distance_mm);
    EXPECT_FALSE(job.move(1).largest_distance_mm);
    EXPECT_LT(job.move(2).largest_distance_mm.value(), 0.01);
    EXPECT_EQ(job.moves_without_distance(), 2);
    EXPECT_EQ(job.move(0).motors.at(1).made_steps, 100);
}

}  // namespace
}  // namespace lockstep::analysis
