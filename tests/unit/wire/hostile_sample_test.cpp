// An invalid sample is refused, and the invalid field is named.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "services/wire/translate/translate.hpp"
#include "tests/unit/wire/random_messages.hpp"

namespace lockstep {
namespace {

/// Sets an enumeration to an invalid number, as a hostile sender may.
template <typename Enum>
void overwrite(Enum& field, std::uint32_t number) {
    static_assert(sizeof field == sizeof number);
    std::memcpy(&field, &number, sizeof number);
}

template <typename Wire>
void expect_refused(const Wire& wire, const std::string& field) {
    const auto received = from_wire(wire);
    ASSERT_FALSE(received) << "accepted with a wrong " << field;
    EXPECT_NE(received.error().find(field), std::string::npos) << received.error();
}

/// Two axes: bodies of two pieces and one, tails of one.
Frame good_frame() {
    const Piece piece{{100}, {1000}, {-10}};
    return {.number = 1,
            .ticks = {200},
            .touch = {.any_of = {{MotorIndex{0}, 3}, {MotorIndex{1}, 3}}},
            .axes = {{{}, {piece, piece}, {piece}}, {{}, {piece}, {piece}}}};
}

/// Expects that good_frame() is refused after `lie` has altered its message.
void expect_frame_refused(const std::string& field, const std::function<void(SetpointMessage&)>& lie) {
    SetpointMessage message = to_wire(good_frame());
    ASSERT_TRUE(from_wire(message));
    lie(message);
    expect_refused<lockstep_wire_Setpoint>(message, field);
}

TEST(HostileFrame, WrongCountsAreRefused) {
    expect_frame_refused("number of axes", [](auto& m) { m.from_count._length = 0; });
    expect_frame_refused("number of axes", [](auto& m) { m.from_count._length = kMaxAxes + 1; });
    expect_frame_refused("number of phases", [](auto& m) { m.from_phase._length = 1; });
    expect_frame_refused("number of body counts", [](auto& m) { m.body_count._length = 1; });
    expect_frame_refused("number of tail counts", [](auto& m) { m.tail_count._length = 0; });
    expect_frame_refused("number of ticks", [](auto& m) { m.storage.body_count[0] = 3; });
    expect_frame_refused("number of ticks", [](auto& m) { m.storage.tail_count[1] = 0; });
    expect_frame_refused("body count", [](auto& m) { m.storage.body_count[0] = 65535; });
    expect_frame_refused("tail count", [](auto& m) { m.storage.tail_count[1] = kMaxTailPieces + 1; });
    expect_frame_refused("number of ticks", [](auto& m) { m.ticks._length = 4; });
    expect_frame_refused("number of velocities", [](auto& m) { m.velocity._length = 4; });
    expect_frame_refused("number of accelerations", [](auto& m) { m.acceleration._length = 4; });
    expect_frame_refused("number of touch_motor", [](auto& m) { m.touch_motor._length = kMaxTouchInputs + 1; });
    expect_frame_refused("number of touch_channel", [](auto& m) { m.touch_channel._length = 1; });
    expect_frame_refused("number of touch_motor with touch_ceases", [](auto& m) {
        m.touch_ceases = true;
        m.touch_motor._length = m.touch_channel._length = 0;
    });
}

TEST(HostileFrame, NumbersThatWouldOverflowAreRefused) {
    constexpr auto kMin = std::numeric_limits<std::int64_t>::min();
    constexpr auto kMax = std::numeric_limits<std::int64_t>::max();
    expect_frame_refused("start_tick", [](auto& m) { m.start_tick = kMax; });
    expect_frame_refused("frame_ticks", [](auto& m) { m.frame_ticks = 0; });
    expect_frame_refused("frame_ticks", [](auto& m) { m.frame_ticks = kMax; });
    expect_frame_refused("from_count", [](auto& m) { m.storage.from_count[1] = kMin; });
    expect_frame_refused("ticks", [](auto& m) { m.storage.ticks[0] = -1; });
    expect_frame_refused("ticks", [](auto& m) { m.storage.ticks[4] = kMax; });
    expect_frame_refused("velocity", [](auto& m) { m.storage.velocity[2] = kMin; });
    expect_frame_refused("acceleration", [](auto& m) { m.storage.acceleration[2] = kMin; });
    expect_frame_refused("touch_motor", [](auto& m) { m.storage.touch_motor[1] = kMaxAxes; });
    expect_frame_refused("touch_channel", [](auto& m) { m.storage.touch_channel[0] = kMostInputs; });
}

/// Any bytes may overwrite a message. The translation refuses it, or its result is within bounds.
TEST(HostileFrame, RandomDamageNeverGetsPastTheBounds) {
    RandomMessages random(2);
    for (int i = 0; i < 2000; ++i) {
        SetpointMessage message = to_wire(good_frame());
        auto& target = message.storage;
        switch (random.index(4)) {
            case 0: target.body_count[random.index(2)] = static_cast<std::uint16_t>(random.bits()); break;
            case 1: target.ticks[random.index(5)] = static_cast<std::int64_t>(random.bits()); break;
            case 2: target.velocity[random.index(5)] = static_cast<std::int64_t>(random.bits()); break;
            default: message.ticks._length = random.index(6);
        }
        const auto received = from_wire(message);
        if (!received) { continue; }
        for (const AxisTrack& axis : received->axes) {
            for (const Piece& piece : axis.body) { EXPECT_LE(piece.ticks.value, INT32_MAX); }
        }
    }
}

TEST(HostileAxisState, IsRefused) {
    const auto good = [] { return to_wire(RandomMessages(3).axis_state()); };
    const auto refused = [&](const char* field, auto lie) {
        auto wire = good();
        lie(wire);
        expect_refused(wire, field);
    };
    refused("axis", [](auto& w) { w.axis = kMaxAxes; });
    refused("phase", [](auto& w) { overwrite(w.phase, 7); });
    refused("phase", [](auto& w) { overwrite(w.phase, 0xFFFFFFFF); });
    refused("stamp", [](auto& w) { w.stamp = INT64_MIN; });
    refused("tick", [](auto& w) { w.tick = INT64_MAX; });
    refused("position_count", [](auto& w) { w.position_count = INT64_MIN; });
    refused("velocity", [](auto& w) { w.velocity = INT64_MIN; });
    refused("following_error_steps", [](auto& w) { w.following_error_steps = INT64_MIN; });
    refused("clock_error_ticks", [](auto& w) { w.clock_error_ticks = -1; });
}

TEST(HostileAxisHealth, IsRefused) {
    const auto refused = [](const char* field, auto lie) {
        auto wire = to_wire(RandomMessages(5).axis_health());
        lie(wire);
        expect_refused(wire, field);
    };
    refused("axis", [](auto& w) { w.axis = kMaxAxes; });
    refused("tick", [](auto& w) { w.tick = INT64_MIN; });
    refused("step_lateness", [](auto& w) { w.step_lateness.least = INT64_MIN; });
    refused("step_interval", [](auto& w) { w.step_interval.most = INT64_MAX; });
    refused("setpoint_slack", [](auto& w) { w.setpoint_slack.most = INT64_MAX; });
    refused("loop_p99_ticks", [](auto& w) { w.loop_p99_ticks = INT64_MAX; });
    refused("setpoint_age_ticks", [](auto& w) { w.setpoint_age_ticks = INT64_MIN; });
    refused("clock_error_ticks", [](auto& w) { w.clock_error_ticks = INT64_MAX; });
}

TEST(HostileClockMessages, AreRefused) {
    auto request = to_wire(ClockRequest{});
    request.axis = kMaxAxes;
    expect_refused(request, "axis");
    request = to_wire(ClockRequest{});
    request.sent = INT64_MIN;
    expect_refused(request, "sent");
    auto reply = to_wire(ClockReply{});
    reply.received = INT64_MAX;
    expect_refused(reply, "received");
    reply = to_wire(ClockReply{});
    reply.answered = INT64_MIN;
    expect_refused(reply, "answered");
}

TEST(HostileMachineState, IsRefused) {
    const auto refused = [](const char* field, auto lie) {
        auto wire = to_wire(RandomMessages(4).machine_state());
        lie(wire);
        expect_refused(wire, field);
    };
    refused("phase", [](auto& w) { overwrite(w.phase, 10); });
    refused("outcome", [](auto& w) { overwrite(w.outcome, 3); });
    refused("fault_axis", [](auto& w) { w.fault_axis = kMaxAxes; });
    refused("progress", [](auto& w) { w.progress = 1.01; });
    refused("progress", [](auto& w) { w.progress = std::nan(""); });
    refused("remaining_s", [](auto& w) { w.remaining_s = std::numeric_limits<double>::infinity(); });
    refused("stamp", [](auto& w) { w.stamp = INT64_MAX; });
    refused("spindle", [](auto& w) { overwrite(w.spindle, 3); });
    refused("spindle_rpm", [](auto& w) { w.spindle_rpm = std::nan(""); });
}

TEST(HostileAxisCommands, AreRefused) {
    const auto refused = [](const char* field, const auto& change) {
        auto wire = to_wire(AxisCommand{});
        change(wire);
        expect_refused(wire, field);
    };
    refused("kind", [](auto& w) { overwrite(w.kind, lockstep_wire_AXIS_CORRECT + 1); });
    refused("target_steps", [](auto& w) { w.target_steps = INT64_MAX; });
    refused("axis", [](auto& w) { w.axis = kMaxAxes; });
    refused("speed_mm_s", [](auto& w) { w.speed_mm_s = std::nan(""); });
    refused("until", [](auto& w) { w.until = INT64_MAX; });
}

TEST(HostileCommands, AreRefused) {
    const auto refused = [](const char* field, const auto& change) {
        auto wire = to_wire(Command{.jogs = {{.axis = AxisIndex{1}, .speed_mm_s = 2}}});
        change(static_cast<lockstep_wire_Command&>(wire));
        expect_refused(static_cast<const lockstep_wire_Command&>(wire), field);
    };
    refused("kind", [](auto& w) { overwrite(w.kind, 13); });
    refused("ticks", [](auto& w) { w.ticks = -1; });
    refused("the number of jogs", [](auto& w) { w.jogs._length = lockstep_wire_MAX_JOGS + 1; });
    refused("a jog's axis", [](auto& w) { w.jogs._buffer[0].axis = kMaxAxes; });
    refused("a jog's speed_mm_s", [](auto& w) { w.jogs._buffer[0].speed_mm_s = std::nan(""); });
    refused("a jog's distance_mm",
            [](auto& w) { w.jogs._buffer[0].distance_mm = std::numeric_limits<double>::infinity(); });
    refused("writer_name", [](auto& w) { std::memset(w.writer_name, 'n', sizeof w.writer_name); });
    refused("writer_name", [](auto& w) { std::strcpy(w.writer_name, "\x1b[2Janna"); });
    refused("writer_host", [](auto& w) {
        std::strcpy(w.writer_host,
                    "bench\xc2\x9b"
                    "2J");
    });
}

TEST(HostileMachineState, AWritersNameCannotCommandATerminal) {
    auto wire = to_wire(MachineState{.lease = HeldLease{{7, "J\xc3\xbcrgen", "bench"}, {}}});
    EXPECT_TRUE(from_wire(static_cast<const lockstep_wire_MachineState&>(wire)));
    std::strcpy(wire.writer_name, "anna\n");
    expect_refused(static_cast<const lockstep_wire_MachineState&>(wire), "writer_name");
}

TEST(HostileMachineState, APausesTextCannotCommandATerminal) {
    auto wire = to_wire(MachineState{.pause = MachinePause{{PauseReason::ToolChange, 2, "end mill"}, {1, 2}}});
    const auto& read = static_cast<const lockstep_wire_MachineState&>(wire);
    EXPECT_TRUE(from_wire(read));
    std::strcpy(wire.pause_text, "end\x1b[2J");
    expect_refused(read, "pause_text");
    std::strcpy(wire.pause_text, "end mill");
    wire.pause_tool = -1;
    expect_refused(read, "pause_tool");
    wire.pause_tool = 2;
    wire.pause_place._length = kMaxAxes + 1;
    expect_refused(read, "number of places");
}

TEST(HostileChunk, IsRefused) {
    const ProgramChunk good{.index = 0, .count = 1, .bytes = {1, 2, 3}};
    auto wire = to_wire(good);
    wire.count = 0xFFFFFFFF;
    expect_refused(wire, "count");
    wire = to_wire(good);
    wire.share = 1.5;
    expect_refused(wire, "share");
    wire = to_wire(good);
    wire.index = 1;
    expect_refused(wire, "index");
    wire = to_wire(good);
    wire.bytes._length = kMaxChunkBytes + 1;
    expect_refused(wire, "number of bytes");
}

TEST(HostileValues, AreRefused) {
    const MachineValues good{.bytes = {1, 2, 3}};
    auto wire = to_wire(good);
    wire.bytes._length = kMaxValuesBytes + 1;
    expect_refused(wire, "number of bytes");
}

TEST(HostileEvent, IsRefused) {
    const auto refuse = [](const std::string& field, const std::function<void(lockstep_wire_ProgramEvent&)>& lie) {
        auto wire = to_wire(RandomMessages(7).event());
        ASSERT_TRUE(from_wire(wire));
        lie(wire);
        expect_refused(wire, field);
    };
    refuse("tick", [](auto& m) { m.tick = std::numeric_limits<std::int64_t>::min(); });
    refuse("kind", [](auto& m) { m.kind = kEventWords.size(); });
    refuse("index", [](auto& m) { m.index = -1; });
    refuse("index", [](auto& m) { m.index = kMaxEventIndex + 1; });
    refuse("value", [](auto& m) { m.value = std::nan(""); });
}

TEST(HostileReply, IsRefused) {
    auto wire = to_wire(Reply{});
    overwrite(wire.status, 2);
    expect_refused(wire, "status");
    wire = to_wire(Reply{});
    std::fill(std::begin(wire.text), std::end(wire.text), 'x');  // no terminating zero
    expect_refused(wire, "text");
}

}  // namespace
}  // namespace lockstep
