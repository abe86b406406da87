// One axis's part of the record: every step, where the axis is, and what it was told to run.
#pragma once

#include <memory>
#include <vector>

#include "core/axis/axis_controller.hpp"
#include "services/record/record_sink.hpp"
#include "services/wire/lcm_channels.hpp"
#include "services/wire/step_batcher.hpp"
#include "services/wire/translate_lcm.hpp"

namespace lockstep {

class AxisRecorder {
public:
    /// `sink` outlives the recorder. `incarnation` is the axis's identity.
    AxisRecorder(const MachineConfig& machine, std::size_t axis, Identity incarnation, RecordSink& sink);

    AxisRecorder(const AxisRecorder&) = delete;  // the batcher publishes through this object
    AxisRecorder& operator=(const AxisRecorder&) = delete;

    /// Every step, in order, before the loop's outputs.
    void step(StepEdge step) { placed_ ? batcher_.add(step) : early_.push_back(step); }
    /// After each loop, at this machine time: its outputs, and what the axis's zero then is. Times in the record are
    /// the device's, which are machine time where that is shared.
    void loop(Tick now, const AxisOutputs& out, std::int64_t zero_count);
    void health(const AxisHealth& health) { sink_.publish(channels_.health, to_lcm(machine_, health)); }
    /// At the end: what is still in hand.
    void finish() { batcher_.flush(); }

private:
    void place(const AxisState& state);

    MachineConfig machine_;
    std::size_t axis_;
    Identity incarnation_;
    RecordSink& sink_;
    AxisChannels channels_;
    StepBatcher batcher_;
    std::int64_t zero_count_ = 0;
    std::uint64_t runs_ = 0;
    bool placed_ = false;          // it is known where the device stands: it may have outlived another process
    std::vector<StepEdge> early_;  // until then
};

}  // namespace lockstep
