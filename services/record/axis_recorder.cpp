#include "services/record/axis_recorder.hpp"

namespace lockstep {

AxisRecorder::AxisRecorder(const MachineConfig& machine, std::size_t axis, Identity incarnation, RecordSink& sink)
    : machine_(machine),
      axis_(axis),
      incarnation_(incarnation),
      sink_(sink),
      channels_(channels_of(machine.name, machine.axes[axis].name)),
      batcher_({.machine = machine.name,
                .axis = machine.axes[axis].name,
                .axis_index = static_cast<std::uint32_t>(axis),
                .incarnation = incarnation,
                .tick_ns = machine.tick_ns},
               0, [this](const step_batch_t& batch) { sink_.publish(channels_.steps, batch); }) {}

/// The count before the first step there is: where the axis stands, less the steps it had made by then.
void AxisRecorder::place(const AxisState& state) {
    std::int64_t before = state.position.count();
    for (const StepEdge& step : early_) { before -= step.tick <= state.tick ? step.direction : 0; }
    batcher_.set_position(before);
    for (const StepEdge& step : early_) { batcher_.add(step); }
    early_.clear();
    placed_ = true;
}

void AxisRecorder::loop(Tick now, const AxisOutputs& out, std::int64_t zero_count) {
    std::optional<AxisState> state = out.state;
    if (state) { state->tick += out.device_ahead; }
    if (!placed_ && state) { place(*state); }
    for (const ExecutedTrack& track : out.tracks) {
        const RunRecord record{.machine = machine_.name,
                               .axis = machine_.axes[axis_].name,
                               .incarnation = incarnation_,
                               .sequence = runs_++,
                               .epoch = track.epoch,
                               .frame = track.frame,
                               .tail = track.tail,
                               .start = track.start,
                               .from = track.from,
                               .cut_at_steps = track.cut ? std::optional(track.stop_count) : std::nullopt,
                               .zero_count = track.zero_count,
                               .pieces = track.pieces};
        sink_.publish(channels_.run, to_lcm(record, machine_.tick_ns));
    }
    if (zero_count != zero_count_) {
        batcher_.set_position(batcher_.position_steps() - (zero_count - zero_count_));
        zero_count_ = zero_count;
    }
    batcher_.poll(now + out.device_ahead);
    if (state) { sink_.publish(channels_.position, to_lcm(machine_, *state)); }
}

}  // namespace lockstep
