// The events of a running job are printed in plain words, and gaps between them are named.
#include "clients/lockstep/job/event_lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/text/event_text.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = ProgramEvent::Kind;

PublishedEvent flood_on(std::uint64_t number, std::optional<std::int32_t> line, std::uint64_t job = 5) {
    return {.term = {.number = 2, .coordinator = 7},
            .sequence = number,
            .job = job,
            .line = line,
            .event = {.kind = Kind::FloodOn}};
}

TEST(EventText, NamesEachKindInPlainWords) {
    EXPECT_EQ(event_text({.kind = Kind::SpindleStop}), "spindle stop");
    EXPECT_EQ(event_text({.kind = Kind::SpindleForward, .value = 12'000}), "spindle forward, 12000 rev/min");
    EXPECT_EQ(event_text({.kind = Kind::SpindleReverse, .value = 0.5}), "spindle reverse, 0.5 rev/min");
    EXPECT_EQ(event_text({.kind = Kind::SpindleSpeed, .value = 800}), "spindle speed, 800 rev/min");
    EXPECT_EQ(event_text({.kind = Kind::CoolantOff}), "coolant off");
    EXPECT_EQ(event_text({.kind = Kind::MistOn}), "mist on");
    EXPECT_EQ(event_text({.kind = Kind::FloodOn}), "flood on");
    EXPECT_EQ(event_text({.kind = Kind::OutputOn, .index = 3}), "output 3 on");
    EXPECT_EQ(event_text({.kind = Kind::OutputOff, .index = 3}), "output 3 off");
    EXPECT_EQ(event_text({.kind = Kind::AnalogOutput, .index = 1, .value = -2.5}), "analog output 1 to -2.5");
    EXPECT_EQ(event_text({.kind = Kind::Tool, .index = 4}), "tool 4 in the spindle");
    EXPECT_EQ(event_text({.kind = Kind::Tool}), "no tool in the spindle");
}

TEST(EventWords, AreThoseOfAProgram) {
    EXPECT_EQ(event_words({.kind = Kind::SpindleStop}), "M5");
    EXPECT_EQ(event_words({.kind = Kind::SpindleForward, .value = 12'000}), "M3 S12000");
    EXPECT_EQ(event_words({.kind = Kind::SpindleReverse, .value = 0.5}), "M4 S0.5");
    EXPECT_EQ(event_words({.kind = Kind::SpindleSpeed, .value = 800}), "S800");
    EXPECT_EQ(event_words({.kind = Kind::CoolantOff}), "M9");
    EXPECT_EQ(event_words({.kind = Kind::OutputOn, .index = 3}), "M62 P3");
    EXPECT_EQ(event_words({.kind = Kind::AnalogOutput, .index = 1, .value = -2.5}), "M67 E1 Q-2.5");
    EXPECT_EQ(event_words({.kind = Kind::Tool}), "T0");
}

TEST(EventLines, AreOneForEachEventOfTheJob) {
    EventLines lines(5);
    EXPECT_THAT(lines.of(std::vector{flood_on(1, 12), flood_on(2, {})}), ElementsAre("line 12: flood on", "flood on"));
    EXPECT_THAT(lines.of(std::vector{flood_on(3, 14)}), ElementsAre("line 14: flood on"));
    EXPECT_THAT(lines.of({}), IsEmpty());
}

TEST(EventLines, LeaveOutOtherJobs) {
    EventLines lines(5);
    EXPECT_THAT(lines.of(std::vector{flood_on(1, 12, 4), flood_on(2, 13)}), ElementsAre("line 13: flood on"));
}

TEST(EventLines, NameWhatTheCoordinatorSwitchedOffAtTheJobsEnd) {
    PublishedEvent off = flood_on(1, {});
    off.is_of_program = false;
    off.event.kind = Kind::CoolantOff;
    EXPECT_THAT(EventLines(5).of(std::vector{off}), ElementsAre("coolant off, at the job's end"));
}

TEST(EventLines, ReportEventsThatWereNotReceived) {
    EventLines lines(5);
    EXPECT_THAT(lines.of(std::vector{flood_on(10, 1), flood_on(13, 4)}),
                ElementsAre("line 1: flood on", "2 events not received", "line 4: flood on"));
}

TEST(EventLines, CountEachCoordinatorsEventsByThemselves) {
    EventLines lines(5);
    PublishedEvent heirs = flood_on(9, 2);
    heirs.term = {.number = 3, .coordinator = 8};
    EXPECT_THAT(lines.of(std::vector{flood_on(1, 1), heirs}), ElementsAre("line 1: flood on", "line 2: flood on"));
}

}  // namespace
}  // namespace lockstep
