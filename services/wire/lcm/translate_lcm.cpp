#include "services/wire/lcm/translate_lcm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/axis/state/fsm.hpp"
#include "core/enumeration.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/names.hpp"

namespace lockstep {
namespace {

/// Returns the same 64 bits as a signed number, because LCM has no unsigned numbers.
std::int64_t bits(std::uint64_t value) { return static_cast<std::int64_t>(value); }

constexpr std::array<std::string_view, kCountOf<ChannelEvent::Kind>> kChannelKinds{"input", "digital", "analog",
                                                                                   "compare-begins", "compare-ends"};

template <typename Small>
bool fits(std::int32_t number) {
    return number >= 0 && number <= std::numeric_limits<Small>::max();
}

}  // namespace

std::int64_t utime_of(Tick machine, std::int64_t tick_ns) { return machine.value * tick_ns / 1000; }

axis_position_t to_lcm(const MachineConfig& machine, const AxisState& state, RecordNumber number) {
    const double steps_per_mm = motor_steps_per_mm(machine, state.motor());
    const double steps_per_s = state.velocity.steps_per_tick() * machine.ticks_per_second();
    axis_position_t out{};
    out.utime = utime_of(state.tick, machine.tick_ns);
    out.tick = state.tick.value;
    out.machine = machine.name;
    out.axis = motor_name(machine, state.motor());
    out.incarnation = bits(number.incarnation);
    out.sequence = bits(number.sequence);
    out.position_steps = state.position.count();
    out.position_mm = static_cast<double>(state.position.count()) / steps_per_mm;
    out.velocity_steps_per_s = steps_per_s;
    out.velocity_mm_per_s = steps_per_s / steps_per_mm;
    out.state = name_of(state.phase);
    out.homed = state.homed ? 1 : 0;
    out.fault = static_cast<std::int32_t>(state.fault);
    out.following_error_steps = state.following_error_steps;
    return out;
}

axis_health_t to_lcm(const MachineConfig& machine, const AxisHealth& health, RecordNumber number) {
    const auto us = [&](Ticks ticks) { return machine.microseconds(ticks); };
    axis_health_t out{};
    out.utime = utime_of(health.tick, machine.tick_ns);
    out.tick = health.tick.value;
    out.machine = machine.name;
    out.axis = motor_name(machine, MotorIndex{health.axis});
    out.incarnation = bits(number.incarnation);
    out.sequence = bits(number.sequence);
    out.steps_compared = bits(health.step_lateness.count);
    out.step_lateness_min_us = us(health.step_lateness.least);
    out.step_lateness_max_us = us(health.step_lateness.most);
    out.step_intervals = bits(health.step_interval.count);
    out.step_interval_min_us = us(health.step_interval.least);
    out.step_interval_max_us = us(health.step_interval.most);
    out.setpoints = bits(health.setpoint_slack.count);
    out.setpoint_slack_min_ms = us(health.setpoint_slack.least) * 1e-3;
    out.setpoint_slack_max_ms = us(health.setpoint_slack.most) * 1e-3;
    out.least_free_segments = static_cast<std::int32_t>(health.least_free_segments);
    out.least_free_captures = static_cast<std::int32_t>(health.least_free_captures);
    out.loop_p50_us = us(health.loop.p50);
    out.loop_p99_us = us(health.loop.p99);
    out.loop_max_us = us(health.loop.most);
    out.awaits_setpoint = health.setpoint_age ? 1 : 0;
    out.setpoint_age_ms = us(health.setpoint_age.value_or(Ticks{})) * 1e-3;
    out.clock_error_us = us(health.clock_error);
    out.refused_frames = bits(health.refused.frames);
    out.refused_commands = bits(health.refused.commands);
    out.refused_messages = bits(health.refused.messages);
    out.refused_orders = bits(health.refused.orders);
    out.lost_captures = bits(health.refused.captures);
    out.lost_records = bits(health.refused.records);
    out.skipped_loops = bits(health.refused.skipped_loops);
    return out;
}

void to_lcm(const ChannelRecord& record, std::int64_t tick_ns, channel_event_t& out) {
    const ChannelEvent& event = record.event;
    out.utime = utime_of(record.clock.other, tick_ns);
    out.incarnation = bits(record.number.incarnation);
    out.sequence = bits(record.number.sequence);
    out.lost = bits(record.lost);
    out.tick = event.tick.value;
    out.ahead = (record.clock.at(event.tick) - event.tick).value;
    out.clock_error = record.clock.error_at(event.tick).value;
    out.zero_count = record.zero_count;
    out.kind = name_of(event.kind);
    out.channel = event.channel;
    out.closed = event.closed ? 1 : 0;
    out.levels = event.levels;
    out.value = event.value;
    out.detail = event.detail;
}

std::optional<ChannelEvent> event_of(const channel_event_t& message) {
    const auto kind = std::ranges::find(kChannelKinds, message.kind) - kChannelKinds.begin();
    const bool is_known = kind != std::ssize(kChannelKinds);
    if (!is_known || !fits<std::uint8_t>(message.channel) || !fits<std::uint16_t>(message.levels)) {
        return std::nullopt;
    }
    return ChannelEvent{.tick = {message.tick},
                        .kind = static_cast<ChannelEvent::Kind>(kind),
                        .channel = static_cast<std::uint8_t>(message.channel),
                        .closed = message.closed != 0,
                        .levels = static_cast<std::uint16_t>(message.levels),
                        .value = message.value,
                        .detail = message.detail};
}

std::string_view name_of(ChannelEvent::Kind kind) { return pick_row(kChannelKinds, kind); }

run_t to_lcm(const RunRecord& record, std::int64_t tick_ns) {
    run_t out{};
    to_lcm(record, tick_ns, out);
    return out;
}

void to_lcm(const RunRecord& record, std::int64_t tick_ns, run_t& out) {
    out.utime = utime_of(record.start + record.ahead, tick_ns);
    out.machine = record.machine;
    out.axis = record.axis;
    out.incarnation = bits(record.incarnation);
    out.sequence = bits(record.sequence);
    out.epoch = bits(record.epoch);
    out.frame = bits(record.frame);
    out.tail = record.tail ? 1 : 0;
    out.start_tick = record.start.value;
    out.ahead = record.ahead.value;
    out.clock_error = record.clock_error.value;
    out.start_count = record.from.count();
    out.start_phase = bits(record.from.phase());
    out.cut = record.cut_at_steps ? 1 : 0;
    out.zero_count = record.zero_count;
    out.pieces = static_cast<std::int32_t>(record.pieces.size());
    for (auto* numbers : {&out.ticks, &out.velocity, &out.acceleration, &out.commanded_ticks}) { numbers->clear(); }
    Position end = record.from;
    for (const Piece& piece : record.pieces) {
        out.ticks.push_back(piece.ticks.value);
        out.velocity.push_back(piece.velocity.raw);
        out.acceleration.push_back(piece.acceleration.raw);
        end = end + piece.covered();
    }
    out.retimed = static_cast<std::int32_t>(record.commanded_ticks.size());
    for (const Ticks ticks : record.commanded_ticks) { out.commanded_ticks.push_back(ticks.value); }
    out.stop_count = record.cut_at_steps.value_or(end.count());
}

record_mark2_t to_lcm(const RecordMark& mark, Tick then, std::int64_t tick_ns) {
    record_mark2_t out{};
    out.utime = utime_of(then, tick_ns);
    out.machine = mark.machine;
    out.witness = mark.witness;
    out.process = mark.process;
    out.incarnation = bits(mark.incarnation);
    out.ended = mark.ended ? 1 : 0;
    out.steps = bits(mark.counts.steps);
    out.runs = bits(mark.counts.runs);
    out.positions = bits(mark.counts.positions);
    out.figures = bits(mark.counts.figures);
    out.channel_events = bits(mark.counts.channel_events);
    out.job_events = bits(mark.counts.job_events);
    out.program_parts = bits(mark.counts.program_parts);
    return out;
}

job_t to_lcm(const JobRecord& record, Tick now, std::int64_t tick_ns) {
    job_t out{};
    out.utime = utime_of(now, tick_ns);
    out.machine = record.machine;
    out.coordinator = bits(record.coordinator);
    out.sequence = bits(record.sequence);
    out.job = bits(record.job);
    out.kind = record.kind;
    out.event = record.event;
    out.outcome = record.outcome;
    out.epoch = bits(record.epoch);
    out.start_tick = record.start.value;
    out.resume_block = record.resume_block;
    out.resume_high = static_cast<std::int64_t>(record.resume_along >> 64);
    out.resume_low = static_cast<std::int64_t>(record.resume_along);
    out.behind_frame = bits(record.behind_frame);
    out.feed_percent = record.overrides.feed_percent;
    out.rapid_percent = record.overrides.rapid_percent;
    out.config = record.config;
    out.program = record.program;
    out.axes = static_cast<std::int32_t>(record.start_count.size());
    out.start_count = record.start_count;
    return out;
}

program_event_t to_lcm(const EventRecord& record, Tick now, std::int64_t tick_ns) {
    const PublishedEvent& event = record.event;
    program_event_t out{};
    out.utime = utime_of(now, tick_ns);
    out.machine = record.machine;
    out.coordinator = bits(record.number.incarnation);
    out.sequence = bits(record.number.sequence);
    out.term = bits(event.term.number);
    out.number = bits(event.sequence);
    out.job = bits(event.job);
    out.epoch = bits(event.epoch);
    out.tick = event.tick.value;
    out.at_rest = event.at_rest ? 1 : 0;
    out.of_program = event.is_of_program ? 1 : 0;
    out.block = event.block;
    out.line = event.line.value_or(0);
    out.kind = name_of(event.event.kind);
    out.index = event.event.index;
    out.value = event.event.value;
    return out;
}

std::optional<ProgramEvent> event_of(const program_event_t& message) {
    const auto place = std::ranges::find(kEventWords, message.kind, &EventWords::name) - kEventWords.begin();
    if (place == std::ssize(kEventWords) || !std::isfinite(message.value)) { return std::nullopt; }
    return ProgramEvent{.kind = static_cast<ProgramEvent::Kind>(place), .index = message.index, .value = message.value};
}

}  // namespace lockstep
