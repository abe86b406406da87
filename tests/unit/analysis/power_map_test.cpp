// The power at each place: as the words of a program ask for it, and as the steps and changes on record made it.
#include "clients/analysis/power/power_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clients/analysis/power/asked_power.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

using drawing::Point;
using testing::HasSubstr;
using Kind = ProgramEvent::Kind;

constexpr double kStep_mm = 0.01;
constexpr std::int64_t kTicksForStep = 1000;  // 10 mm/s

channel_event_t laser(std::int64_t sequence, std::int64_t tick, double value, double slope = 0) {
    channel_event_t message{};
    message.axis = "X";
    message.kind = "analog";
    message.sequence = sequence;
    message.tick = tick;
    message.value = static_cast<std::int64_t>(value * static_cast<double>(kFullScale));
    message.detail = static_cast<std::int64_t>(slope * static_cast<double>(kFullScale));
    return message;
}

PowerMeter meter() { return {PowerTrack("X", 0), kStep_mm, 1000}; }

/// From X 0 to 10 mm, a step each kTicksForStep.
void run_along_x(PowerMeter& meter, std::int64_t begin = 0) {
    for (std::int64_t k = 0; k <= 1000; ++k) {
        meter.at({begin + k * kTicksForStep}, {static_cast<double>(k) * kStep_mm, 5});
    }
}

/// The sums from one X to another.
PowerSums sums_between(const PowerGrid& grid, double from_mm, double to_mm) {
    PowerSums sums;
    const CellBounds& bounds = grid.bounds();
    for (std::int64_t j = bounds.bottom; j < bounds.bottom + bounds.height; ++j) {
        for (std::int64_t i = bounds.left; i < bounds.left + bounds.width; ++i) {
            const double middle = (static_cast<double>(i) + 0.5) * grid.cell_mm();
            if (middle > from_mm && middle < to_mm) { sums.add(grid.at(i, j)); }
        }
    }
    return sums;
}

TEST(PowerGrid, DividesALineByItsLengthInEachCell) {
    PowerGrid grid(1);
    grid.add({-1.5, 0.5}, {2.5, 0.5}, {.path_mm = 4, .energy_s = 8});
    EXPECT_EQ(grid.bounds().left, -2);
    EXPECT_EQ(grid.bounds().width, 5);
    EXPECT_DOUBLE_EQ(grid.at(-2, 0).path_mm, 0.5);
    EXPECT_DOUBLE_EQ(grid.at(0, 0).energy_s, 2);
    EXPECT_DOUBLE_EQ(grid.at(2, 0).energy_s, 1);
}

TEST(PowerGrid, HasABoundedNumberOfCellsAndLosesNothing) {
    PowerGrid grid(0.01, PowerGrid::Keeps::All);
    for (int k = 0; k < 1000; ++k) {
        const double x = std::cos(k) * k;
        grid.add({x, -k * 0.5}, {x + 3, -k * 0.5 + 1}, {.path_mm = 1});
    }
    EXPECT_LE(grid.bounds().width, PowerGrid::kMostAcross);
    EXPECT_LE(grid.bounds().height, PowerGrid::kMostAcross);
    EXPECT_NEAR(sums_between(grid, -1e9, 1e9).path_mm, 1000, 1e-9);
}

TEST(PowerGrid, IsNotWidenedByPathWithoutPower) {
    PowerGrid grid(1);
    grid.add({0, 0.5}, {4, 0.5}, {.path_mm = 4, .burned_mm = 4});
    PowerGrid approach(1, PowerGrid::Keeps::All);
    approach.add({-1000, 0.5}, {2, 0.5}, {.path_mm = 1002});
    EXPECT_GT(approach.cell_mm(), 1);
    grid.add(approach);
    grid.add({2, 0.5}, {9, 0.5}, {.path_mm = 7});
    EXPECT_EQ(grid.bounds().width, 4);
    EXPECT_DOUBLE_EQ(grid.cell_mm(), 1);
    EXPECT_DOUBLE_EQ(grid.at(3, 0).path_mm, 2);
}

TEST(PowerGrid, AddsAFinerOneCellByCell) {
    PowerGrid fine(0.5, PowerGrid::Keeps::All);
    fine.add({-0.5, 0}, {0.5, 0}, {.path_mm = 1});
    PowerGrid coarse(2, PowerGrid::Keeps::All);
    coarse.add({0, 0}, {1, 0}, {.path_mm = 1});
    coarse.add(fine);
    EXPECT_DOUBLE_EQ(coarse.at(-1, 0).path_mm, 0.5);
    EXPECT_DOUBLE_EQ(coarse.at(0, 0).path_mm, 1.5);
}

TEST(PowerMeter, PlacesAChangeWhereThePathWas) {
    PowerMeter made = meter();
    made.take(laser(0, 0, 0));
    made.take(laser(1, 250'500, 0.5));  // at 2.505 mm
    made.take(laser(2, 750'000, 0));
    run_along_x(made);
    made.finish();
    ASSERT_EQ(made.changes().size(), 3U);
    EXPECT_NEAR(made.changes()[1].place_mm.x, 2.505, 1e-9);
    EXPECT_NEAR(sums_between(made.made(), 0, 2.45).energy_s, 0, 1e-12);
    EXPECT_NEAR(sums_between(made.made(), 0, 10).energy_s, 0.5 * 0.4995, 1e-9);
    EXPECT_NEAR(sums_between(made.made(), 3, 7).power(), 0.5, 1e-12);
    EXPECT_NEAR(sums_between(made.made(), 3, 7).energy(), 0.5 / 10, 1e-9);
}

TEST(PowerMeter, FollowsARampUntilFullScale) {
    PowerMeter made = meter();
    made.take(laser(0, 0, 0, 1.0 / 524'288));  // full at 5.24288 mm
    run_along_x(made);
    made.finish();
    EXPECT_NEAR(sums_between(made.made(), 0, 10).energy_s, 0.524288 / 2 + (1 - 0.524288), 1e-9);
}

TEST(PowerMeter, DoesNotKnowThePowerWhereAChangeIsMissing) {
    PowerMeter made = meter();
    made.take(laser(0, 0, 0.5));
    made.take(laser(1, 200'000, 1));
    made.take(laser(3, 600'000, 0));  // number 2 is missing
    made.take(laser(4, 900'000, 1));
    run_along_x(made);
    made.finish();
    EXPECT_NEAR(sums_between(made.made(), 0, 2).power(), 0.5, 1e-9);
    const PowerSums unknown = sums_between(made.made(), 2.1, 5.9);
    EXPECT_NEAR(unknown.unknown_mm, unknown.path_mm, 1e-9);
    EXPECT_EQ(unknown.energy_s, 0);
    EXPECT_EQ(sums_between(made.made(), 6.1, 8.9).unknown_mm, 0);
    EXPECT_NEAR(sums_between(made.made(), 9.1, 10).power(), 1, 1e-9);
}

TEST(PowerMeter, DoesNotKnowThePowerBeforeTheFirstChangeOrAfterTheDeviceLostSome) {
    PowerMeter made = meter();
    made.take(laser(0, 200'000, 1));
    channel_event_t lossy = laser(1, 600'000, 0);
    lossy.lost = 3;
    made.take(lossy);
    run_along_x(made);
    made.finish();
    EXPECT_NEAR(sums_between(made.made(), 0, 10).unknown_mm, 6, 1e-6);
}

TEST(PowerMeter, TakesShuffledAndRepeatedMessagesInTheirOrder) {
    PowerMeter made = meter();
    for (const std::int64_t number : {2, 0, 2, 1, 0}) {
        made.take(laser(number, 300'000 * number, number == 1 ? 1 : 0));
    }
    run_along_x(made);
    made.finish();
    EXPECT_NEAR(sums_between(made.made(), 0, 10).energy_s, 0.3, 1e-9);
    EXPECT_EQ(sums_between(made.made(), 0, 10).unknown_mm, 0);
}

TEST(PowerMeter, KeepsTheEnergyOfARestAtItsPlace) {
    PowerMeter made = meter();
    made.take(laser(0, 0, 0.5));
    for (std::int64_t k = 0; k <= 500; ++k) { made.at({k * kTicksForStep}, {static_cast<double>(k) * kStep_mm, 5}); }
    for (std::int64_t k = 501; k <= 1000; ++k) {
        made.at({1'000'000 + k * kTicksForStep}, {static_cast<double>(k) * kStep_mm, 5});
    }
    made.finish();
    EXPECT_NEAR(sums_between(made.made(), 4.95, 5.05).energy_s, 0.5 * (1 + 0.01), 0.006);
    EXPECT_NEAR(sums_between(made.made(), 0, 10).energy_s, 1, 1e-9);
}

/// 4 mm at 300 of 1000, then 4 mm at 1000, at 10 mm/s. And back in a rapid move.
RecordedProgram engraving() {
    Program program = test::path_through({{0, 5}, {4, 5}, {8, 5}, {0, 5}});
    for (Block& block : program.blocks) { std::get<ProgramMove>(block.action).feed_mm_s = 10; }
    std::get<ProgramMove>(program.blocks[2].action).rapid = true;
    const auto event = [](Kind kind, double value) {
        return Block{.line = 1, .action = ProgramEvent{.kind = kind, .value = value}};
    };
    program.blocks.insert(program.blocks.begin() + 1, event(Kind::SpindleSpeed, 1000));
    program.blocks.insert(program.blocks.begin(), event(Kind::SpindleReverse, 300));
    return RecordedProgram(std::move(program));
}

OutputConfig following_laser() {
    return {.name = "laser",
            .motor = "X",
            .use = OutputUse::Spindle,
            .pwm = PwmConfig{.hz = 5000, .full_scale = 1000, .follows_speed = true}};
}

TEST(AskedPower, IsThatOfTheWordsAtTheFeed) {
    PowerGrid asked(0.04);
    add_asked_power(engraving(), following_laser(), asked);
    EXPECT_NEAR(sums_between(asked, 0, 4).power(), 0.3, 1e-9);
    EXPECT_NEAR(sums_between(asked, 4, 8).power(), 1, 1e-9);
    EXPECT_NEAR(sums_between(asked, 4, 8).energy(), 0.1, 1e-9);
    EXPECT_NEAR(sums_between(asked, 0, 8).path_mm, 16, 1e-9) << "there and back";
}

TEST(PowerMap, ComparesWhatIsAskedWithWhatWasMade) {
    PowerGrid asked(0.04);
    add_asked_power(engraving(), following_laser(), asked);
    PowerMeter made = meter();
    made.take(laser(0, 0, 0.3));
    made.take(laser(1, 400'000, 0.9));
    made.take(laser(2, 800'000, 0));
    run_along_x(made);
    made.finish();
    const PowerMap map = power_map("laser", std::move(asked), made.made(), {{{400'000}, {4, 5}}}, made.changes());
    EXPECT_EQ(map.asked.bounds().width, map.made.bounds().width);
    EXPECT_NEAR(map.most_energy, 0.1, 1e-9);
    EXPECT_EQ(map.changes_compared, 1U);
    EXPECT_NEAR(map.largest_place_mm, 0, 1e-9);
}

TEST(PowerMap, FindsAPowerThatIsNotAskedFor) {
    Program program = test::path_through({{0, 5}, {8, 5}});
    program.blocks.insert(program.blocks.begin(),
                          {.line = 1, .action = ProgramEvent{.kind = Kind::SpindleForward, .value = 1000}});
    std::get<ProgramMove>(program.blocks[1].action).feed_mm_s = 10;
    PowerGrid asked(0.04);
    add_asked_power(RecordedProgram(std::move(program)), following_laser(), asked);
    PowerMeter made = meter();
    made.take(laser(0, 0, 1));
    made.take(laser(1, 400'000, 0.9));
    run_along_x(made);
    made.finish();
    const PowerMap map = power_map("laser", std::move(asked), made.made(), {}, made.changes());
    EXPECT_NEAR(map.largest_energy_difference.value_or(0), 0.1, 1e-6);
}

TEST(PowerMap, IsDrawnWithWhatIsNotKnownInWords) {
    PowerGrid asked(0.04);
    add_asked_power(engraving(), following_laser(), asked);
    PowerMeter made = meter();
    made.take(laser(0, 0, 0.3));
    made.take(laser(2, 800'000, 0));
    run_along_x(made);
    made.finish();
    const PowerMap map = power_map("laser", std::move(asked), made.made(), {}, made.changes());
    EXPECT_NEAR(map.unknown_mm, 8, 1e-6);
    EXPECT_THAT(power_svg(map, "power of laser"), HasSubstr("? not known: changes missing from the log"));
    const PowerShades picture = shades(map, map.made, PowerShades::Quantity::Power, 16);
    EXPECT_EQ(picture.numbers.size(), picture.width * picture.height);
    EXPECT_TRUE(std::ranges::count(picture.numbers, PowerShades::kNotKnown) > 0);
}

}  // namespace
}  // namespace lockstep::analysis
