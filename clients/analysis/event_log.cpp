#include "clients/analysis/event_log.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/faults.hpp"

namespace lockstep::analysis {
namespace {

Event fault_event(const axis_position_t& message) {
    const FaultText* known = find_fault(static_cast<FaultCode>(message.fault));
    Event event{.at = {message.tick}, .what = {}, .axis = message.axis, .remedy = {}, .is_fault = true};
    event.what = fmt::format("fault {}", message.fault);
    if (known == nullptr) { return event; }
    event.what += fmt::format(", {}: {}", known->name, known->cause);
    event.remedy = remedy_text(*known);
    return event;
}

/// When a run that was cut made its last step; its start if it made none.
Tick ceased(const Run& run) {
    StepMaker steps(run);
    Tick last = run.commanded_start();
    for (; steps.count() != run.stop_count && steps.next() != nullptr; steps.pass()) { last = steps.commanded(); }
    return last;
}

}  // namespace

void EventLog::take(const axis_position_t& message) {
    at_steps_[message.axis] = message.position_steps;
    const bool is_older = !faults_.contains(message.axis) && message.sequence > 0;  // it began before the log
    const std::int32_t before = std::exchange(faults_[message.axis], message.fault);
    if (message.fault != 0 && message.fault != before && !is_older) { note(fault_event(message)); }
}

/// The end of a frame is not an event. A tail is one, because it runs only if the next frame was vetoed or not
/// received.
void EventLog::take(const std::string& axis, const Run& run) {
    if (run.epoch == 0) { return; }
    if (run.cut) {
        note({.at = ceased(run), .what = "pulses stopped at once, in " + name_of(run), .axis = axis, .remedy = {}});
    }
    if (!run.tail || std::exchange(latest_tail_, std::pair{run.epoch, run.frame}) == std::pair{run.epoch, run.frame}) {
        return;
    }
    note({.at = run.commanded_start(),
          .what = "began to come to rest, by the " + name_of(run),
          .axis = {},
          .remedy = {}});
}

void EventLog::note(Event event) {
    if (events_.size() == kEventsKept) {
        ++not_kept_;
        return;
    }
    event.at_steps = at_steps_;
    events_.push_back(std::move(event));
}

}  // namespace lockstep::analysis
