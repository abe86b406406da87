#include "services/record/axis_recorder.hpp"

#include <algorithm>
#include <numeric>

#include "core/kinematics/motors.hpp"

namespace lockstep {

AxisRecorder::AxisRecorder(const MachineConfig& machine, MotorIndex motor, Identity incarnation, RecordSink& sink)
    : machine_(machine),
      motor_(motor),
      incarnation_(incarnation),
      sink_(sink),
      channels_(channels_of(machine.name, motor_name(machine, motor))),
      batcher_({.machine = machine.name,
                .axis = motor_name(machine, motor),
                .axis_index = static_cast<std::uint32_t>(motor),
                .incarnation = incarnation,
                .tick_ns = machine.tick_ns},
               0, [this](step_batch_t& batch) { publish(batch); }),
      marker_(machine, motor_name(machine, motor), sink) {
    channel_event_.machine = machine.name;
    channel_event_.axis = motor_name(machine, motor);
}

/// Sets the count before the first recorded step to the axis's position minus its steps so far.
void AxisRecorder::place(const AxisState& state) {
    const Tick read = clock_.own + (state.tick - clock_.other);
    std::int64_t before = state.position.count();
    for (const StepEdge& step : steps_) { before -= step.tick <= read ? step.direction : 0; }
    batcher_.set_position(before);
    placed_ = true;
}

void AxisRecorder::batch_steps() {
    if (!placed_) { return; }
    for (const StepEdge& step : steps_) { batcher_.add(step); }
    steps_.clear();
}

void AxisRecorder::publish_channel_events() {
    for (const ChannelEvent& event : channel_events_) {
        to_lcm(ChannelRecord{.number = {incarnation_, counts_.channel_events++},
                             .lost = lost_channel_events_,
                             .zero_count = zero_count_,
                             .clock = clock_,
                             .event = event},
               machine_.tick_ns, channel_event_);
        sink_.publish(channels_.channels, channel_event_);
    }
    channel_events_.clear();
}

void AxisRecorder::finish() {
    batch_steps();
    publish_channel_events();
    batcher_.flush();
    marker_.note_end(motor_name(machine_, motor_), incarnation_, counts_, clock_.other);
}

/// Adds the steps' machine times from the newest clock estimate. An improved estimate may put them before the end of
/// the previous batch. Then they are recorded just after that end, and their error bound grows by the shift.
void AxisRecorder::publish(step_batch_t& batch) {
    const Tick first{batch.first_tick};
    const Tick last = std::accumulate(batch.delta_ticks.begin(), batch.delta_ticks.end(), first,
                                      [](Tick tick, std::int32_t delta) { return tick + Ticks{delta}; });
    const Tick begins = clock_.at(first);
    const Ticks shift = published_ ? std::max(Ticks{}, *published_ + Ticks{1} - begins) : Ticks{};
    published_ = clock_.at(last) + shift;
    batch.utime = utime_of(clock_.other, machine_.tick_ns);
    batch.ahead_first = (begins + shift - first).value;
    batch.ahead_last = (*published_ - last).value;
    batch.clock_error = (std::max(clock_.error_at(first), clock_.error_at(last)) + shift).value;
    sink_.publish(channels_.steps, batch);
    ++counts_.steps;
}

void AxisRecorder::loop(const AxisOutputs& out, std::int64_t zero_count, std::uint64_t lost_captures) {
    clock_ = out.device_clock;
    if (out.state) { marker_.note(motor_name(machine_, motor_), incarnation_, counts_, clock_.other); }
    if (out.device_changed) { placed_ = false; }
    if (!placed_ && out.state) {
        place(*out.state);
        zero_count_ = zero_count;  // a process may begin homed, so its first zero is not a jump
    }
    batch_steps();
    publish_channel_events();
    for (const ExecutedTrack& track : out.tracks) {
        const RunRecord record{.machine = machine_.name,
                               .axis = motor_name(machine_, motor_),
                               .incarnation = incarnation_,
                               .sequence = counts_.runs++,
                               .epoch = track.epoch,
                               .frame = track.frame,
                               .tail = track.tail,
                               .start = track.start,
                               .from = track.from,
                               .cut_at_steps = track.cut ? std::optional(track.stop_count) : std::nullopt,
                               .zero_count = track.zero_count,
                               .pieces = track.pieces,
                               .ahead = track.commanded_start - track.start,
                               .commanded_ticks = track.commanded_ticks,
                               .clock_error = track.clock_error};
        to_lcm(record, machine_.tick_ns, run_);
        sink_.publish(channels_.run, run_);
    }
    if (zero_count != zero_count_) {
        batcher_.set_position(batcher_.position_steps() - (zero_count - zero_count_));
        zero_count_ = zero_count;
    }
    if (lost_captures != lost_captures_) {  // the next state gives the position again
        lost_captures_ = lost_captures;
        placed_ = false;
    }
    batcher_.poll(clock_.own);
    if (!out.state) { return; }
    sink_.publish(channels_.position, to_lcm(machine_, *out.state, {incarnation_, counts_.positions++}));
}

}  // namespace lockstep
