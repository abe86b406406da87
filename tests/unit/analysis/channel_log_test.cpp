// The changes of inputs and outputs in a log: listed in the order of time, by the names of the machine's file.
#include "clients/analysis/channels/channel_log.hpp"
#include "services/setup/machine_setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace lockstep::analysis {
namespace {

using ChannelKind = ChannelEvent::Kind;
using drawing::Point;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Tick kEnd{1000};

channel_event_t channel_message(const char* motor, std::int64_t tick, const char* kind, std::int64_t sequence = 0) {
    channel_event_t message{};
    message.sequence = sequence;
    message.axis = motor;
    message.tick = tick;
    message.kind = kind;
    return message;
}

channel_event_t digital(const char* motor, std::int64_t tick, std::int32_t levels, std::int64_t sequence = 0) {
    channel_event_t message = channel_message(motor, tick, "digital", sequence);
    message.levels = levels;
    return message;
}

TEST(ChannelLog, ListsEachOutputThatChangesInMachineTime) {
    ChannelLog log;
    channel_event_t late = digital("Y", 500, 0b101);
    late.ahead = 20;
    log.take(late);
    log.take(digital("Y", 600, 0b100, 1));
    channel_event_t laser = channel_message("X", 550, "analog");
    laser.value = kFullScale / 4;
    log.take(laser);
    log.finish(kEnd);
    const auto& changes = log.changes();
    ASSERT_EQ(changes.size(), 4U);
    EXPECT_EQ(changes[0], (ChannelChange{{520}, "Y", ChannelKind::Digital, 0, 1}));
    EXPECT_EQ(changes[1], (ChannelChange{{520}, "Y", ChannelKind::Digital, 2, 1}));
    EXPECT_EQ(changes[2], (ChannelChange{{550}, "X", ChannelKind::Analog, 0, 0.25}));
    EXPECT_EQ(changes[3], (ChannelChange{{600}, "Y", ChannelKind::Digital, 0, 0}));
}

TEST(ChannelLog, ListsShuffledAndRepeatedMessagesAsTheyHappened) {
    ChannelLog log;
    for (const std::int64_t number : {2, 0, 2, 3, 1, 0}) {
        log.take(digital("X", number, number % 2 == 0 ? 1 : 0, number));
    }
    log.finish(kEnd);
    const auto& changes = log.changes();
    ASSERT_EQ(changes.size(), 4U);
    for (std::size_t k = 0; k < changes.size(); ++k) {
        EXPECT_EQ(
            changes[k],
            (ChannelChange{{static_cast<std::int64_t>(k)}, "X", ChannelKind::Digital, 0, k % 2 == 0 ? 1.0 : 0.0}));
    }
}

TEST(ChannelLog, KeepsABoundedNumberAndCountsTheRest) {
    ChannelLog log;
    for (std::int64_t i = 0; i < 1200; ++i) { log.take(digital("X", i, i % 2 == 0 ? 1 : 0, i)); }
    EXPECT_EQ(log.not_kept(), 200U);
    log.finish(kEnd);
    EXPECT_EQ(log.changes().size(), ChannelLog::kChangesKept);
}

TEST(ChannelLog, LeavesOutMessagesWithImpossibleNumbers) {
    ChannelLog log;
    log.take(channel_message("X", 1, "no such kind"));
    log.take(digital("X", std::int64_t{1} << 62, 1));
    log.finish(kEnd);
    EXPECT_TRUE(log.changes().empty());
}

channel_event_t analog(std::int64_t tick, double value, double slope, std::int64_t sequence) {
    channel_event_t message = channel_message("X", tick, "analog", sequence);
    message.value = static_cast<std::int64_t>(value * static_cast<double>(kFullScale));
    message.detail = static_cast<std::int64_t>(slope * static_cast<double>(kFullScale));
    return message;
}

TEST(ChannelCourses, FollowARampUntilItsBoundAndADigitalOutputFromItsFirstMessage) {
    ChannelLog log;
    log.take(analog(100, 0.5, 0.25 / 64, 0));
    log.take(digital("Y", 200, 0b00, 0));
    log.take(analog(500, 0.25, 0, 1));
    log.take(digital("Y", 600, 0b10, 1));
    log.finish(kEnd);
    const auto courses = log.courses();
    ASSERT_EQ(courses.size(), 2U);
    EXPECT_EQ(courses[0].origin(), Tick{100});
    EXPECT_THAT(courses[0].points(),
                ElementsAre(Point{0, 0.5}, Point{128, 1}, Point{400, 1}, Point{400, 0.25}, Point{900, 0.25}));
    EXPECT_THAT(courses[0].unknown(), IsEmpty());
    EXPECT_EQ(courses[1].channel(), 1);
    EXPECT_EQ(courses[1].origin(), Tick{200});
    EXPECT_THAT(courses[1].points(), ElementsAre(Point{0, 0}, Point{400, 0}, Point{400, 1}, Point{800, 1}));
}

TEST(ChannelCourses, AreNotKnownWhereChangesAreMissing) {
    ChannelLog log;
    log.take(analog(100, 0.5, 0, 0));
    log.take(digital("X", 150, 1, 1));
    log.take(analog(300, 1, 0, 3));
    log.finish(kEnd);
    const auto courses = log.courses();
    ASSERT_EQ(courses.size(), 2U);
    EXPECT_EQ(courses[0].kind(), ChannelKind::Digital);
    EXPECT_THAT(courses[0].unknown(), ElementsAre(UnknownTime{{150}, {1000}}));
    EXPECT_THAT(courses[1].unknown(), ElementsAre(UnknownTime{{150}, {300}}));
    EXPECT_THAT(courses[1].points(), ElementsAre(Point{0, 0.5}, Point{50, 0.5}, Point{200, 1}, Point{900, 1}));
}

TEST(ChannelCourses, AreNotKnownAfterTheDeviceLostChangesUntilTheNextOne) {
    ChannelLog log;
    log.take(analog(100, 0.5, 0, 0));
    channel_event_t after = analog(300, 1, 0, 1);
    after.lost = 4;
    log.take(after);
    log.finish(kEnd);
    EXPECT_THAT(log.courses()[0].unknown(), ElementsAre(UnknownTime{{100}, {300}}));
}

TEST(ChannelCourses, KeepABoundedNumberOfPointsAndEveryPeak) {
    ChannelLog log;
    for (std::int64_t i = 0; i < 100'000; ++i) { log.take(analog(10 * i, i == 77'777 ? 1 : 0, 0, i)); }
    log.finish({1'000'000});
    const auto courses = log.courses();
    EXPECT_LE(courses[0].points().size(), drawing::ThinnedCurve::kMostPoints);
    EXPECT_EQ(std::ranges::max(courses[0].points(), {}, &Point::y).y, 1);
}

TEST(ChannelChange, HasTheNameOfTheMachinesFile) {
    MachineSetup machine;
    machine.inputs = {{.name = "door", .motor = "X", .channel = 4, .use = InputUse::Door}};
    machine.outputs = {{.name = "laser", .motor = "X", .use = OutputUse::Spindle, .pwm = PwmConfig{}},
                       {.name = "air", .motor = "X", .use = OutputUse::Flood}};
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Input, 4, 1}, &machine), "door closed");
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Analog, 0, 0.3}, &machine), "laser 30 %");
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Digital, 0, 1}, &machine), "air on");
    EXPECT_EQ(change_text({{}, "Y", ChannelKind::Digital, 0, 0}, &machine), "digital output 0 off");
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Input, 2, 0}, &machine), "home switch open");
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Input, 3, 0}, nullptr), "input 3 open");
}

}  // namespace
}  // namespace lockstep::analysis
