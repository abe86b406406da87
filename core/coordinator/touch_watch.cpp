#include "core/coordinator/touch_watch.hpp"

#include <utility>

namespace lockstep {
namespace {

/// The job moves to where this input, a probe's, touches or opens.
bool probes_with(const InputConfig& input, const MachineActivity& activity) {
    const auto* const path = activity.as<activity::OnPath>();
    return path != nullptr && path->task.probe && path->task.probe->input == input.number;
}

}  // namespace

/// At the first look no input has just closed.
bool TouchWatch::has_just_closed(std::size_t input, const LoopView& loop) {
    const auto is_closed = loop.axes.is_closed(input);
    if (!is_closed) { return false; }
    return !std::exchange(were_closed_[input], is_closed).value_or(true) && *is_closed;
}

std::vector<std::size_t> TouchWatch::look(const MachineActivity& activity, const LoopView& loop) {
    std::vector<std::size_t> touched;
    were_closed_.resize(loop.machine.inputs.size());
    for (std::size_t i = 0; i < loop.machine.inputs.size(); ++i) {
        const InputConfig& input = loop.machine.inputs[i];
        if (input.at_touch_in_motion == TouchInMotion::Nothing || !has_just_closed(i, loop)) { continue; }
        if (activity.in_motion() && !probes_with(input, activity)) { touched.push_back(i); }
    }
    return touched;
}

}  // namespace lockstep
