// The changes of inputs and outputs in a log: listed in the order of time, by the names of the machine's file.
#include "clients/analysis/channels/channel_log.hpp"

#include <gtest/gtest.h>

namespace lockstep::analysis {
namespace {

using ChannelKind = ChannelEvent::Kind;

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
    const auto changes = log.finish();
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
    const auto changes = log.finish();
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
    EXPECT_EQ(log.finish().size(), ChannelLog::kChangesKept);
}

TEST(ChannelLog, LeavesOutMessagesWithImpossibleNumbers) {
    ChannelLog log;
    log.take(channel_message("X", 1, "no such kind"));
    log.take(digital("X", std::int64_t{1} << 62, 1));
    EXPECT_TRUE(log.finish().empty());
}

TEST(ChannelChange, HasTheNameOfTheMachinesFile) {
    MachineConfig machine;
    machine.inputs = {{.name = "door", .motor = "X", .channel = 4, .use = InputUse::Door}};
    machine.outputs = {{.name = "laser", .motor = "X", .use = OutputUse::Spindle, .pwm = PwmConfig{}},
                       {.name = "air", .motor = "X", .use = OutputUse::Flood}};
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Input, 4, 1}, &machine), "door closed");
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Analog, 0, 0.3}, &machine), "laser 30 %");
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Digital, 0, 1}, &machine), "air on");
    EXPECT_EQ(change_text({{}, "Y", ChannelKind::Digital, 0, 0}, &machine), "digital output 0 off");
    EXPECT_EQ(change_text({{}, "X", ChannelKind::Input, 2, 0}, nullptr), "input 2 open");
}

}  // namespace
}  // namespace lockstep::analysis
