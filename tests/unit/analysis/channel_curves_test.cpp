// The courses of outputs in pictures over time: bars and curves with the words of programs, broken where changes are
// missing.
#include "clients/analysis/channel_curves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "clients/analysis/figures.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::even_steps;
using test::LogMaker;
using test::path_through;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Kind = ProgramEvent::Kind;

struct ChannelCurves : testing::Test {
    std::filesystem::path log = test::test_directory() / "run.lcm";
    MachineSetup machine = with_laser();

    static MachineSetup with_laser() {
        MachineSetup machine = test::two_axes();
        machine.outputs = {{.name = "laser",
                            .motor = "X",
                            .use = OutputUse::Spindle,
                            .pwm = PwmConfig{.hz = 5000, .full_scale = 1000}},
                           {.name = "air", .motor = "X", .use = OutputUse::Flood}};
        return machine;
    }
    /// X makes a step each ms from 0.1 s to 0.3 s. The laser is on from 0.15 s to 0.25 s, the air from 0.2 s.
    Analysis analysis_without(std::int64_t missing) const {
        {
            const Program program = path_through({{0, 0}, {2, 0}});
            LogMaker maker(log, machine);
            maker.job("begun", 0, program);
            maker.steps("X", 0, 0, even_steps(100'000, 200, 1000));
            maker.steps("Y", 0, 0, even_steps(100'000, 1, 1000));
            maker.event({.tick = {150'000}, .line = 1, .event = {.kind = Kind::SpindleForward, .value = 500}});
            maker.event({.tick = {200'000}, .line = 2, .event = {.kind = Kind::FloodOn}});
            const auto share = [](double of) {
                return static_cast<std::int64_t>(of * static_cast<double>(kFullScale));
            };
            const std::vector<ChannelEvent> events{
                {.tick = {100'000}, .kind = ChannelEvent::Kind::Analog},
                {.tick = {120'000}, .kind = ChannelEvent::Kind::Digital, .levels = 0},
                {.tick = {150'000}, .kind = ChannelEvent::Kind::Analog, .value = share(0.5)},
                {.tick = {200'000}, .kind = ChannelEvent::Kind::Digital, .levels = 1},
                {.tick = {220'000}, .kind = ChannelEvent::Kind::Input, .channel = 2, .closed = true},
                {.tick = {250'000}, .kind = ChannelEvent::Kind::Analog}};
            for (std::int64_t i = 0; i < std::ssize(events); ++i) {
                if (i != missing) { maker.channel("X", i, events[static_cast<std::size_t>(i)]); }
            }
            maker.job("ended", 300'000, program, "done");
        }
        auto found = analyze_log(log);
        EXPECT_TRUE(found) << found.error();
        return *std::move(found);
    }
};

TEST_F(ChannelCurves, ShowEachOutputThatTheMachinesFileNamesWithTheWordsThatSwitchIt) {
    const auto curves = channel_curves(analysis_without(-1));
    ASSERT_EQ(curves.size(), 2U);
    EXPECT_EQ(curves[0].curve.axis, "air");
    EXPECT_THAT(curves[0].levels.value(), ElementsAre("off", "on"));
    EXPECT_THAT(curves[0].asked, ElementsAre("M8"));
    EXPECT_EQ(curves[1].curve.axis, "laser");
    EXPECT_EQ(curves[1].curve.unit, "%");
    EXPECT_THAT(curves[1].asked, ElementsAre("M3 S500"));
    EXPECT_THAT(curves[1].curve.value, ElementsAre(0, 0, 50, 50, 0, 0));
    EXPECT_NEAR(curves[1].curve.time_s[2], 0.05, 1e-9);
    EXPECT_THAT(curves[1].curve.missing, IsEmpty());
}

TEST_F(ChannelCurves, AreBrokenWhereAChangeIsMissing) {
    const Analysis analysis = analysis_without(2);
    const auto curves = channel_curves(analysis);
    const drawing::AxisCurve& laser = curves.at(1).curve;
    ASSERT_EQ(laser.missing.size(), 1U);
    EXPECT_NEAR(laser.missing[0].from, 0.02, 1e-9) << "the last change that is known to have none missing before it";
    EXPECT_NEAR(laser.missing[0].to, 0.15, 1e-9) << "the next change of the laser";
    EXPECT_TRUE(std::ranges::any_of(laser.value, [](double value) { return std::isnan(value); }));
    EXPECT_THAT(drawing::to_svg(outputs_figure(analysis)), HasSubstr("not known: changes missing from the log"));
}

TEST_F(ChannelCurves, AreAPictureOfTheirOwn) {
    const auto pictures = test::test_directory() / "pictures";
    analysis_without(-1);
    AnalysisOptions options;
    options.svg_dir = pictures;
    ASSERT_TRUE(analyze_log(log, options));
    EXPECT_TRUE(std::filesystem::exists(pictures / "outputs.svg"));
}

}  // namespace
}  // namespace lockstep::analysis
