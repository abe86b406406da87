// Compares the events by which the coordinator switched devices off, since a job ended before its end: one for each
// device that was on and may not stay on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/verification/events/event_findings.hpp"
#include "clients/verification/events/known_devices.hpp"
#include "clients/verification/events/recorded_events.hpp"
#include "core/outputs/output_config.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::verification {

class SwitchedOff {
public:
    SwitchedOff(RecordedEvents& recorded, KnownDevices& devices, EventFindings& findings)
        : recorded_(recorded), devices_(devices), findings_(findings) {}

    /// The outputs of the job's machine.
    void set_outputs(std::span<const OutputConfig> outputs) { outputs_.assign(outputs.begin(), outputs.end()); }
    void check(JobOutcome outcome);

private:
    bool check_off(const ProgramEvent& end, bool is_planned);

    RecordedEvents& recorded_;
    KnownDevices& devices_;
    EventFindings& findings_;
    std::vector<OutputConfig> outputs_;
};

}  // namespace lockstep::verification
