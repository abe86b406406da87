// One axis's part of the record: every step, the axis's position, and the runs it was ordered.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/axis/axis_controller.hpp"
#include "services/record/record_marker.hpp"
#include "services/record/record_sink.hpp"
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
    /// Call it after each loop: with the loop's outputs, the axis's zero after it, and how many steps so far have no
    /// recorded time: they are missing after those of this loop. Steps and runs are recorded in the device's time and
    /// in machine time.
    void loop(const AxisOutputs& out, std::int64_t zero_count, std::uint64_t lost_captures);
    void health(const AxisHealth& health) {
        sink_.publish(channels_.health, to_lcm(machine_, health, {incarnation_, counts_.figures++}));
    }
    /// The coordinator's published counts at that time.
    void note_coordinator(const MachineState& state) {
        marker_.note("", state.term.coordinator, state.published, state.tick);
    }
    RecordCounts published() const { return counts_; }
    /// At the end: publishes what is not yet published.
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
    RecordMarker marker_;
    run_t run_{};  // that was published last
    std::uint64_t lost_captures_ = 0;
    /// The device's position is known: not at first, since the device may have outlived another process, nor after the
    /// device was exchanged, nor after steps without their time.
    bool placed_ = false;
    std::vector<StepEdge> steps_;    // not yet given to the batcher
    ClockView clock_;                // the device's, in machine time, at the last loop
    std::optional<Tick> published_;  // machine time of the last step published
};

}  // namespace lockstep
