#include "clients/analysis/moves/path_distance.hpp"

#include <gtest/gtest.h>

#include "services/record/reading/recorded_program.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

AskedPath diagonal() {
    const auto program = std::make_shared<const RecordedProgram>(test::path_through({{0, 0}, {1, 1}}));
    return AskedPath::of(test::two_axes(), program->head(), program).value();
}

TEST(PathDistance, IsMeasuredAtAPlaceBesideTheLine) {
    const AskedPath asked = diagonal();
    PathDistance distance(asked);
    distance.begin(asked, 0);
    float largest = 0;
    EXPECT_TRUE(distance.step(MotorIndex{0}, 1, 1));
    distance.measure(asked, largest);  // 0.01 mm on X alone
    EXPECT_NEAR(largest, 0.01 * 0.01 / 2, 1e-9);
    EXPECT_TRUE(distance.step(MotorIndex{1}, 1, 1));
    distance.measure(asked, largest);
    EXPECT_NEAR(largest, 0.01 * 0.01 / 2, 1e-9);
}

TEST(PathDistance, OfManyStepsIsThatOfEach) {
    const AskedPath asked = diagonal();
    std::vector<MergedStep> steps;
    for (std::int64_t i = 0; i < 40; ++i) {  // X is three steps ahead
        if (i < 37) { steps.emplace_back(Ticks{100 * i}, 0, 1); }
        if (i >= 3) { steps.emplace_back(Ticks{100 * i + 1}, 1, 1); }
    }
    const std::vector<std::optional<MotorIndex>> motors{MotorIndex{0}, MotorIndex{1}};
    PathDistance together(asked);
    together.begin(asked, 0);
    float largest = 0;
    together.measure(asked, steps, motors, largest);
    PathDistance each(asked);
    each.begin(asked, 0);
    float of_each = 0;
    for (const MergedStep& step : steps) {
        EXPECT_TRUE(each.step(MotorIndex{step.lane()}, each.count(MotorIndex{step.lane()}) + step.direction(),
                              step.direction()));
        each.measure(asked, of_each);
    }
    EXPECT_EQ(largest, of_each);
    EXPECT_EQ(together.count(MotorIndex{0}), 37);
    EXPECT_EQ(together.count(MotorIndex{1}), 37);
}

TEST(PathDistance, NoticesAPlaceThatIsNotTheNext) {
    const AskedPath asked = diagonal();
    PathDistance distance(asked);
    EXPECT_FALSE(distance.step(MotorIndex{0}, 5, 1));
    EXPECT_TRUE(distance.step(MotorIndex{0}, 6, 1));
}

}  // namespace
}  // namespace lockstep::analysis
