// The record's messages are decoded, or refused if a byte of their structure is wrong.
#include "services/wire/lcm/lcm_decode.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Message>
Bytes encoded(const Message& message) {
    Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    return bytes;
}

step_batch_t a_batch() {
    step_batch_t batch{};
    batch.machine = "mill";
    batch.axis = "X";
    batch.sequence = 3;
    batch.count = 3;
    batch.delta_ticks = {0, 10, 12};
    batch.direction = {1, 1, -1};
    return batch;
}

run_t a_run() {
    const Piece pieces[] = {{{10}, {20}, {30}}, {{40}, {50}, {60}}};
    return to_lcm(RunRecord{.machine = "mill", .axis = "X", .sequence = 9, .frame = 2, .pieces = pieces}, 1000);
}

job_t a_job() {
    const JobRecord record{.machine = "mill",
                           .kind = "run",
                           .event = "begun",
                           .resume_along = Int128{-5},
                           .config = "name: 'mill'",
                           .program = "blocks {}",
                           .start_count = {1, 2, 3}};
    return to_lcm(record, {1'000'000}, 1000);
}

program_event_t an_event() {
    return to_lcm(EventRecord{.machine = "mill",
                              .number = {.incarnation = 7, .sequence = 3},
                              .event = {.term = {11, 7},
                                        .sequence = 2,
                                        .job = 5,
                                        .epoch = 900,
                                        .tick = {4000},
                                        .block = 17,
                                        .line = 23,
                                        .event = {ProgramEvent::Kind::SpindleForward, 0, 1200.5}}},
                  {5000}, 1000);
}

MachineConfig a_machine() {
    MachineConfig machine{.name = "mill"};
    machine.axes.push_back({.name = "X", .steps_per_mm = 400});
    return machine;
}

axis_health_t a_health() {
    return to_lcm(a_machine(),
                  AxisHealth{.tick = {5000},
                             .step_lateness = {7, {-2}, {3}},
                             .setpoint_slack = {1, {390'000}, {390'000}},
                             .setpoint_age = Ticks{1500},
                             .refused = {.frames = 4}},
                  {.incarnation = 7, .sequence = 3});
}

axis_position_t a_position() {
    return to_lcm(a_machine(),
                  AxisState{.homed = true, .position = Position::steps(800), .velocity = {INT64_MAX}, .tick = {5000}},
                  {.incarnation = 7, .sequence = 3});
}

flight_head_t a_flight_head() {
    flight_head_t head{};
    head.machine = "mill";
    head.process = "axis-X";
    head.reason = "veto";
    head.config = "name: 'mill'";
    return head;
}

flight_event_t a_flight_event() {
    flight_event_t event{};
    event.machine = "mill";
    event.process = "axis-X";
    event.what = "vetoed";
    event.frame = 17;
    return event;
}

flight_note_t a_flight_note() {
    flight_note_t note{};
    note.machine = "mill";
    note.process = "axis-X";
    note.text = "failed check: a frame has room for its pieces (core/frame.cpp:17)";
    return note;
}

template <typename Message>
void expect_decodes_back(const Message& message) {
    const Bytes bytes = encoded(message);
    const auto decoded = decode_lcm<Message>(bytes);
    ASSERT_TRUE(decoded) << decoded.error();
    EXPECT_EQ(encoded(*decoded), bytes);
}

TEST(LcmDecode, EveryMessageOfTheRecordComesBack) {
    expect_decodes_back(a_batch());
    expect_decodes_back(a_run());
    expect_decodes_back(a_job());
    expect_decodes_back(an_event());
    expect_decodes_back(a_position());
    expect_decodes_back(a_health());
    expect_decodes_back(a_flight_head());
    expect_decodes_back(a_flight_event());
    expect_decodes_back(a_flight_note());
}

TEST(LcmDecode, AMessageThatWasUsedBeforeBecomesTheNextOne) {
    step_batch_t longer = a_batch();
    longer.count = 4;
    longer.delta_ticks.push_back(5);
    longer.direction.push_back(1);
    step_batch_t message;
    ASSERT_TRUE(decode_lcm(std::span<const std::uint8_t>(encoded(longer)), message));
    const auto* const memory = message.delta_ticks.data();
    message.delta_ticks.clear();
    message.direction.clear();
    ASSERT_TRUE(decode_lcm(std::span<const std::uint8_t>(encoded(a_batch())), message));
    EXPECT_EQ(encoded(message), encoded(a_batch()));
    EXPECT_EQ(message.delta_ticks.data(), memory);
}

TEST(LcmDecode, AnotherTypeIsRefused) { EXPECT_FALSE(decode_lcm<run_t>(encoded(a_batch()))); }

/// Cuts the message at every length, and overwrites each of its bytes in turn.
template <typename Message>
void expect_survives_damage(const Message& message) {
    const Bytes whole = encoded(message);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        EXPECT_FALSE(decode_lcm<Message>(std::span(whole).first(length))) << "cut at " << length;
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const std::uint8_t value : Bytes{0x00, 0x7F, 0x80, 0xFF}) {
            Bytes damaged = whole;
            damaged[at] = value;
            (void)decode_lcm<Message>(damaged);  // refused or decoded; neither throws nor allocates without bound
        }
    }
}

TEST(LcmDecode, DamageIsRefusedOrHarmless) {
    expect_survives_damage(a_batch());
    expect_survives_damage(a_run());
    expect_survives_damage(a_job());
    expect_survives_damage(an_event());
    expect_survives_damage(a_position());
    expect_survives_damage(a_health());
    expect_survives_damage(a_flight_head());
    expect_survives_damage(a_flight_event());
    expect_survives_damage(a_flight_note());
}

TEST(LcmDecode, AWrongCountIsRefused) {
    step_batch_t batch = a_batch();
    Bytes bytes = encoded(batch);
    const std::size_t count_at = bytes.size() - 3 * 5 - 4;
    for (const std::uint8_t high : Bytes{0x00, 0x7F, 0xFF}) {
        bytes[count_at] = high;
        bytes[count_at + 1] = 0xFF;
        EXPECT_FALSE(decode_lcm<step_batch_t>(bytes));
    }
}

TEST(ToLcm, APositionIsInStepsAndInMillimetres) {
    const axis_position_t position = a_position();
    EXPECT_EQ(position.position_steps, 800);
    EXPECT_DOUBLE_EQ(position.position_mm, 2.0);
    EXPECT_NEAR(position.velocity_steps_per_s, 500'000, 1);
    EXPECT_NEAR(position.velocity_mm_per_s, 1250, 0.01);
    EXPECT_EQ(position.utime, 5000);
    EXPECT_EQ(position.state, "Initialize");
}

TEST(ToLcm, HealthIsInMicrosecondsAndMilliseconds) {
    const axis_health_t health = a_health();
    EXPECT_EQ(health.axis, "X");
    EXPECT_EQ(health.steps_compared, 7);
    EXPECT_DOUBLE_EQ(health.step_lateness_min_us, -2);
    EXPECT_DOUBLE_EQ(health.step_lateness_max_us, 3);
    EXPECT_DOUBLE_EQ(health.setpoint_slack_min_ms, 390);
    EXPECT_EQ(health.awaits_setpoint, 1);
    EXPECT_DOUBLE_EQ(health.setpoint_age_ms, 1.5);
    EXPECT_EQ(health.refused_frames, 4);
}

TEST(FromLcm, AnEventOfEachKindIsWhatItWas) {
    for (std::size_t kind = 0; kind < kEventWords.size(); ++kind) {
        const ProgramEvent event{.kind = static_cast<ProgramEvent::Kind>(kind), .index = 3, .value = 0.5};
        program_event_t message = an_event();
        message.kind = name_of(event.kind);
        message.index = event.index;
        message.value = event.value;
        EXPECT_EQ(event_of(message), event) << message.kind;
    }
}

TEST(FromLcm, AnEventOfUnknownKindOrWithoutAValueIsRefused) {
    program_event_t message = an_event();
    message.kind = "laser-on";
    EXPECT_FALSE(event_of(message));
    message = an_event();
    message.value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(event_of(message));
}

TEST(ToLcm, AnEventHasItsNumbersAndItsName) {
    const program_event_t event = an_event();
    EXPECT_EQ(event.utime, 5000);
    EXPECT_EQ(event.coordinator, 7);
    EXPECT_EQ(event.sequence, 3);
    EXPECT_EQ(event.term, 11);
    EXPECT_EQ(event.number, 2);
    EXPECT_EQ(event.tick, 4000);
    EXPECT_EQ(event.of_program, 1);
    EXPECT_EQ(event.at_rest, 0);
    EXPECT_EQ(event.block, 17);
    EXPECT_EQ(event.line, 23);
    EXPECT_EQ(event.kind, "spindle-forward");
    EXPECT_DOUBLE_EQ(event.value, 1200.5);
}

TEST(FromLcm, AChangeOfAChannelOfEachKindIsWhatItWas) {
    for (const auto kind : {ChannelEvent::Kind::Input, ChannelEvent::Kind::Digital, ChannelEvent::Kind::Analog,
                            ChannelEvent::Kind::CompareBegins, ChannelEvent::Kind::CompareEnds}) {
        const ChannelEvent event{.tick = {4000},
                                 .kind = kind,
                                 .channel = 7,
                                 .closed = true,
                                 .levels = 0xFFFF,
                                 .value = -(std::int64_t{1} << 62),
                                 .detail = INT64_MIN};
        channel_event_t message{};
        to_lcm(ChannelRecord{.event = event}, 1000, message);
        EXPECT_EQ(event_of(message), event) << message.kind;
    }
}

TEST(FromLcm, AChangeOfAChannelOfUnknownKindOrBeyondItsRangeIsRefused) {
    channel_event_t message{};
    to_lcm(ChannelRecord{}, 1000, message);
    ASSERT_TRUE(event_of(message));
    message.kind = "laser";
    EXPECT_FALSE(event_of(message));
    to_lcm(ChannelRecord{}, 1000, message);
    message.channel = 256;
    EXPECT_FALSE(event_of(message));
    message.channel = 0;
    message.levels = -1;
    EXPECT_FALSE(event_of(message));
}

TEST(ToLcm, AChangeOfAChannelHasItsTickOnBothClocks) {
    channel_event_t message{};
    to_lcm(ChannelRecord{.number = {7, 3},
                         .lost = 2,
                         .zero_count = -50,
                         .clock = {.own = {1000}, .other = {900'000}, .error = {4}},
                         .event = {.tick = {990}}},
           1000, message);
    EXPECT_EQ(message.utime, 900'000);
    EXPECT_EQ(message.tick + message.ahead, 899'990);
    EXPECT_EQ(message.clock_error, 4);
    EXPECT_EQ(message.incarnation, 7);
    EXPECT_EQ(message.sequence, 3);
    EXPECT_EQ(message.lost, 2);
    EXPECT_EQ(message.zero_count, -50);
}

TEST(ToLcm, ARunThatWasNotCutEndsWhereItsPiecesDo) {
    const Piece piece{{1000}, {INT64_MAX}, {0}};  // half a step a tick
    const run_t run = to_lcm(RunRecord{.from = Position::steps(7), .pieces = {&piece, 1}}, 1000);
    EXPECT_EQ(run.cut, 0);
    EXPECT_EQ(run.stop_count, 507);
    EXPECT_EQ(to_lcm(RunRecord{.cut_at_steps = 3, .pieces = {&piece, 1}}, 1000).stop_count, 3);
}

}  // namespace
}  // namespace lockstep
