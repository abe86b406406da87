#include "clients/verification/jobs/planned_outputs.hpp"

#include <utility>
#include <vector>

namespace lockstep::verification {

void PlannedOutputs::begin(const MachineConfig& machine, bool are_known) {
    are_known_ = are_known;
    pulses_.clear();
    for (const OutputConfig& output : machine.outputs) {
        if (output.makes_pulses()) { pulses_.try_emplace(output.motor); }
    }
}

void PlannedOutputs::take(const AxisRun& of, const Frame* frame, MotorIndex motor,
                          const std::function<std::string()>& commanded) {
    const analysis::Run& run = of.run;
    const OutputTrack* const track = frame != nullptr ? frame->outputs_of(motor) : nullptr;
    if (track == nullptr || !on_outputs_ || !are_known_ || run.cut) { return; }
    OutputCheck::Planned planned{.incarnation = run.incarnation,
                                 .begin = run.start,
                                 .end = run.start + run.ticks(),
                                 .changes = {},
                                 .ticks = run.tail ? total_ticks(frame->axes[motor].tail) : frame->ticks,
                                 .is_retimed = !run.commanded_ticks.empty(),
                                 .clock_error = run.clock_error,
                                 .commanded = commanded(),
                                 .pulses = {}};
    const auto take = [&](const auto& changes) { planned.changes.assign(changes.begin(), changes.end()); };
    run.tail ? take(track->tail) : take(track->body);
    if (const auto pulses = pulses_.find(of.axis); pulses != pulses_.end()) {
        if (of.is_behind_gap) { pulses->second.lose(); }
        std::vector<OutputChange> made = planned.changes;
        for (OutputChange& change : made) { change.at = planned.tick_of(change) - planned.begin; }
        planned.pulses = pulses->second.events_of({run, std::move(made), run.tail || frame->last});
    }
    on_outputs_(of.axis, std::move(planned));
}

}  // namespace lockstep::verification
