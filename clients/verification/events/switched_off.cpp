#include "clients/verification/events/switched_off.hpp"

#include <string>

#include "clients/verification/jobs/record_text.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep::verification {

void SwitchedOff::check(JobOutcome outcome) {
    using Kind = ProgramEvent::Kind;
    const ProgramDevices& devices = devices_.state();
    const bool turns = devices.spindle != SpindleDirection::Stopped;
    if (!check_off({.kind = Kind::SpindleStop}, turns)) { return; }
    if (!check_off({.kind = Kind::CoolantOff}, devices.mist || devices.flood)) { return; }
    for (const OutputConfig& output : outputs_) {
        const ProgramEvent end = end_of(output);
        const bool is_off_already = end.kind == Kind::SpindleStop || end.kind == Kind::CoolantOff;
        if (is_off_already || output.stays_after(outcome == JobOutcome::Failed)) { continue; }
        if (!check_off(end, is_active(output, devices))) { return; }
    }
    if (const program_event_t* more = recorded_.next()) {
        (void)findings_.differ("the job's end switched more off than was on: " + text_of(*more), 0, {},
                               Tick{more->tick});
    }
}

/// Returns false if the next event is not the planned one.
bool SwitchedOff::check_off(const ProgramEvent& end, bool is_planned) {
    const program_event_t* there = recorded_.next();
    const std::string name(name_of(end.kind));
    const bool is_there = there != nullptr && there->kind == name && there->index == end.index;
    if (devices_.are_known() && is_there != is_planned) {
        return findings_.differ(
            name + (is_there ? " is recorded at the job's end, but it was off" : " is not recorded at the job's end"),
            0, {}, is_there ? std::optional(Tick{there->tick}) : std::nullopt);
    }
    if (!is_there) { return true; }
    devices_.apply({.kind = end.kind, .index = end.index});
    recorded_.pop();
    ++findings_.all.events;
    return true;
}

}  // namespace lockstep::verification
