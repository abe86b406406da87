// One axis's part of the record: every step, where the axis is, and what it was told to run.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/axis/axis_controller.hpp"
#include "services/record/record_sink.hpp"
#include "services/record/record_witness.hpp"
#include "services/record/step_batcher.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {

class AxisRecorder {
public:
    /// `sink` outlives the recorder. `incarnation` is the axis's identity.
    AxisRecorder(const MachineConfig& machine, std::size_t axis, Identity incarnation, RecordSink& sink);

    AxisRecorder(const AxisRecorder&) = delete;  // the batcher publishes through this object
    AxisRecorder& operator=(const AxisRecorder&) = delete;

    /// Every step, in order, before the loop's outputs.
    void step(StepEdge step) { steps_.push_back(step); }
    /// After each loop: its outputs, what the axis's zero then is, and how many steps so far the device could not keep
    /// the time of: they are missing behind those of this loop. Steps and runs are recorded in the device's time, with
    /// what that is in machine time.
    void loop(const AxisOutputs& out, std::int64_t zero_count, std::uint64_t lost_captures);
    void health(const AxisHealth& health) {
        sink_.publish(channels_.health, to_lcm(machine_, health, {incarnation_, counts_.figures++}));
    }
    /// What the coordinator is known to have published by then.
    void note_coordinator(const MachineState& state) {
        witness_.note("", state.term.coordinator, state.published, state.tick);
    }
    RecordCounts published() const { return counts_; }
    /// At the end: what is still in hand.
    void finish();

private:
    void place(const AxisState& state);
    void batch_steps();
    void publish(step_batch_t& batch);

    MachineConfig machine_;
    std::size_t axis_;
    Identity incarnation_;
    RecordSink& sink_;
    AxisChannels channels_;
    StepBatcher batcher_;
    std::int64_t zero_count_ = 0;
    RecordCounts counts_;  // published so far
    RecordWitness witness_;
    std::uint64_t lost_captures_ = 0;
    /// It is known where the device stands: not at first, since it may have outlived another process, nor where it has
    /// been exchanged, nor after steps without their time.
    bool placed_ = false;
    std::vector<StepEdge> steps_;    // not given to the batcher yet
    ClockView clock_;                // the device's, in machine time, at the last loop
    std::optional<Tick> published_;  // machine time of the last step published
};

}  // namespace lockstep
