// Records one axis: every step, its position, and the runs that it executed.
#pragma once

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
    /// `sink` must outlive the recorder. `incarnation` is the identity of the axis's process.
    AxisRecorder(const MachineConfig& machine, MotorIndex motor, Identity incarnation, RecordSink& sink);

    AxisRecorder(const AxisRecorder&) = delete;  // the batcher publishes through this object
    AxisRecorder& operator=(const AxisRecorder&) = delete;

    /// Makes room for that many steps and changes in one loop, so that it does not allocate memory for fewer.
    void reserve(std::size_t steps, std::size_t channel_events) {
        steps_.reserve(steps);
        channel_events_.reserve(channel_events);
    }
    /// Call it for every step, in order, before loop().
    void step(StepEdge step) { steps_.push_back(step); }
    /// Call it for every change of an input or output of the device, in order, before loop().
    void channel(const ChannelEvent& event) { channel_events_.push_back(event); }
    /// The number of such changes that the device has lost so far. Call it before loop().
    void lost_channel_events(std::uint64_t count) { lost_channel_events_ = count; }
    /// Call it after each loop, with the loop's outputs and the axis's zero after it. `lost_captures` is the number of
    /// steps so far that have no recorded time; new ones are missing after the steps of this loop. Steps and runs are
    /// recorded in the device's time and in machine time.
    void loop(const AxisOutputs& out, std::int64_t zero_count, std::uint64_t lost_captures);
    void health(const AxisHealth& health) {
        sink_.publish(channels_.health, to_lcm(machine_, health, {incarnation_, counts_.figures++}));
    }
    /// Notes the counts that the coordinator had published at the time of this state.
    void note_coordinator(const MachineState& state) {
        marker_.note("", state.term.coordinator, state.published, state.tick);
    }
    RecordCounts published() const { return counts_; }
    /// Call it at the end. Publishes the remaining steps and changes, and the last mark.
    void finish();

private:
    void place(const AxisState& state);
    void batch_steps();
    void publish_channel_events();
    void publish(step_batch_t& batch);

    MachineConfig machine_;
    MotorIndex motor_;
    Identity incarnation_;
    RecordSink& sink_;
    AxisChannels channels_;
    StepBatcher batcher_;
    std::int64_t zero_count_ = 0;
    RecordCounts counts_;  // published so far
    RecordMarker marker_;
    run_t run_{};                               // the run published last
    std::vector<ChannelEvent> channel_events_;  // not yet published
    channel_event_t channel_event_{};           // the last one published
    std::uint64_t lost_channel_events_ = 0;
    std::uint64_t lost_captures_ = 0;
    /// Whether the device's position is known. It is unknown at first, since the device may have outlived another
    /// process, and after a change of the device or steps without a recorded time.
    bool placed_ = false;
    std::vector<StepEdge> steps_;    // not yet given to the batcher
    ClockView clock_;                // the device's clock in machine time, at the last loop
    std::optional<Tick> published_;  // machine time of the last step published
};

}  // namespace lockstep
