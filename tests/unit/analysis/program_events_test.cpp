// The events of programs in a log: listed with their times, lines and places, at most a bounded number of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/figures.hpp"
#include "clients/analysis/report.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::even_steps;
using test::LogMaker;
using test::path_through;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Kind = ProgramEvent::Kind;

/// X 0 to 10 mm, the coolant on, then Y.
Program with_coolant() {
    Program program = path_through({{0, 0}, {10, 0}, {10, 10}});
    program.blocks.insert(program.blocks.begin(),
                          {.line = 7, .action = ProgramEvent{.kind = Kind::SpindleForward, .value = 12'000}});
    program.blocks.insert(program.blocks.begin() + 2, {.line = 8, .action = ProgramEvent{.kind = Kind::FloodOn}});
    return program;
}

PublishedEvent spindle_on(std::int64_t tick) {
    return {.tick = {tick}, .at_rest = true, .line = 7, .event = {.kind = Kind::SpindleForward, .value = 12'000}};
}

PublishedEvent flood_on(std::int64_t tick) {
    return {.epoch = 9, .tick = {tick}, .block = 2, .line = 8, .event = {.kind = Kind::FloodOn}};
}

struct ProgramEvents : testing::Test {
    std::filesystem::path log = test::test_directory() / "run.lcm";

    void record_coolant() const {
        const Program program = with_coolant();
        LogMaker maker(log);
        maker.event(spindle_on(0));  // the coordinator records the events of a step before its jobs
        maker.job("begun", 0, program);
        maker.job("epoch", 1000, program);
        maker.steps("X", 0, 0, even_steps(1000, 200, 1000));
        maker.event(flood_on(300'000));
        maker.steps("Y", 0, 0, even_steps(500'000, 200, 1000));
        maker.event({.tick = {750'000}, .at_rest = true, .is_of_program = false, .event = {.kind = Kind::CoolantOff}});
        maker.job("ended", 800'000, program, "stopped");
    }
    Analysis analysis() const {
        auto found = analyze_log(log);
        EXPECT_TRUE(found) << found.error();
        return *std::move(found);
    }
};

TEST_F(ProgramEvents, AreReportedWithTimeLineKindAndPlace) {
    record_coolant();
    const auto report = to_report(analysis());
    ASSERT_EQ(report.program_events_size(), 3);
    EXPECT_EQ(report.program_events_not_listed(), 0U);
    const auto& spindle = report.program_events(0);
    EXPECT_EQ(spindle.what(), "spindle forward, 12000 rev/min");
    EXPECT_EQ(spindle.kind(), "spindle-forward");
    EXPECT_DOUBLE_EQ(spindle.value(), 12'000);
    EXPECT_EQ(spindle.line(), 7);
    EXPECT_TRUE(spindle.at_rest());
    ASSERT_EQ(spindle.place_size(), 2);
    EXPECT_EQ(spindle.place(0).position_mm(), 0);
    const auto& flood = report.program_events(1);
    EXPECT_EQ(flood.what(), "flood on");
    EXPECT_EQ(flood.tick(), 300'000);
    EXPECT_NEAR(flood.at_s(), 0.299, 1e-9);
    EXPECT_EQ(flood.job(), 3U);
    EXPECT_FALSE(flood.at_rest());
    EXPECT_TRUE(flood.of_program());
    EXPECT_EQ(flood.place(0).name(), "X");
    EXPECT_EQ(flood.place(0).position_mm(), 10);
    EXPECT_EQ(flood.place(0).position_steps(), 1000);
    EXPECT_EQ(flood.place(1).position_mm(), 0);
    EXPECT_FALSE(report.program_events(2).of_program());
    EXPECT_FALSE(report.program_events(2).has_line());
    EXPECT_EQ(report.program_events(2).place_size(), 0);
}

TEST_F(ProgramEvents, AreListedInTheText) {
    record_coolant();
    const std::string text = summary(analysis());
    EXPECT_THAT(text, HasSubstr("    3      0.299       8  flood on                             "
                                "X 10.000 mm  Y 0.000 mm\n"));
    EXPECT_THAT(text, HasSubstr("coolant off                          switched off at the job's end\n"));
    EXPECT_THAT(text, Not(HasSubstr(" more events")));
}

TEST_F(ProgramEvents, HaveNoPlaceWithoutTheirProgram) {
    {
        LogMaker maker(log);
        maker.event(flood_on(300'000));
        maker.steps("X", 0, 0, even_steps(1000, 200, 1000));
        maker.job("ended", 800'000, with_coolant(), "done");
    }
    const Analysis found = analysis();
    ASSERT_EQ(found.program_events.size(), 1U);
    EXPECT_THAT(found.program_events[0].place, IsEmpty());
}

TEST_F(ProgramEvents, OfAnotherJobHaveNoPlacesOfTheProgramBefore) {
    {
        LogMaker maker(log);
        maker.job("begun", 0, with_coolant());
        maker.job("ended", 1000, with_coolant(), "done");
        PublishedEvent other = flood_on(2000);
        other.job = 4;
        maker.event(other);
    }
    EXPECT_THAT(analysis().program_events.at(0).place, IsEmpty());
}

TEST_F(ProgramEvents, AreKeptUpToALimitAndTheOthersCounted) {
    constexpr std::uint64_t kAll = ProgramEventLog::kEventsKept + 500;
    {
        LogMaker maker(log);
        maker.steps("X", 0, 0, even_steps(1000, 200, 1000));
        for (std::uint64_t i = 0; i < kAll; ++i) { maker.event(flood_on(2000 + static_cast<std::int64_t>(i))); }
    }
    const Analysis found = analysis();
    EXPECT_EQ(found.program_events.size(), ProgramEventLog::kEventsKept);
    EXPECT_EQ(to_report(found).program_events_not_listed(), 500U);
    EXPECT_THAT(summary(found), HasSubstr("and 1 480 more events\n"));
}

TEST_F(ProgramEvents, OfUnknownKindAreReportedAsUnreadable) {
    program_event_t strange{};
    strange.machine = "mill";
    strange.kind = "laser-on";
    {
        LogWriter writer = LogWriter::open(log).value();
        writer.write_message(event_channel("mill"), 5000, strange);
        writer.write_message(
            job_channel("mill"), 5000,
            to_lcm(JobRecord{.machine = "mill", .sequence = 1, .job = 1, .kind = "run", .event = "begun"}, {5000},
                   1000));
        ASSERT_TRUE(writer.flush());
    }
    const Analysis found = analysis();
    EXPECT_THAT(found.program_events, IsEmpty());
    ASSERT_FALSE(found.damages.empty());
    EXPECT_THAT(found.damages[0].what, HasSubstr("an event of unknown kind"));
}

TEST_F(ProgramEvents, AreMarkedInThePicturesOverTime) {
    record_coolant();
    const drawing::Figure speed = speed_figure(analysis());
    ASSERT_EQ(speed.rows.size(), 2U);
    for (const drawing::Chart& row : speed.rows) {
        ASSERT_EQ(row.moments.x.size(), 3U);
        EXPECT_NEAR(row.moments.x[1], 0.299, 1e-9);
    }
    EXPECT_THAT(drawing::to_svg(speed), HasSubstr("events of programs"));
}

}  // namespace
}  // namespace lockstep::analysis
