// Compares the recorded events of jobs with those of their programs: each once, in order, and at its place. An event in
// motion must be at the tick that planning the program again gives. An event at rest must be before the place where the
// axes rest.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "clients/verification/events/event_findings.hpp"
#include "clients/verification/events/known_devices.hpp"
#include "clients/verification/events/planned_events.hpp"
#include "clients/verification/events/recorded_events.hpp"
#include "clients/verification/events/switched_off.hpp"
#include "core/coordinator/epoch/epoch_runner.hpp"

namespace lockstep::verification {

class EventCheck {
public:
    explicit EventCheck(Findings& findings) : findings_{findings, {}, 0} {}
    EventCheck(const EventCheck&) = delete;  // its parts refer to each other
    EventCheck& operator=(const EventCheck&) = delete;

    RecordedEvents& recorded() { return recorded_; }
    KnownDevices& devices() { return devices_; }

    /// A job begins. `program`: null if it has no events.
    void begin(std::int64_t coordinator, std::int64_t job, const std::string& label,
               std::shared_ptr<const analysis::RecordedProgram> program);
    void begin_epoch(Epoch epoch, std::int64_t coordinator);
    /// The outputs of the job's machine.
    void set_outputs(std::span<const OutputConfig> outputs) { switched_off_.set_outputs(outputs); }

    /// Compares the events in the frames that were run. `may_end_early`: their coordinator may have ended, or given the
    /// job up, before it published the last ones.
    void check_motion(std::span<const EpochRunner::Happened> planned, bool may_end_early);
    /// Compares events at rest: those before block `must` must have been published, those before `may` may have been.
    void check_rest(std::uint32_t must, std::uint32_t may);
    /// Leaves the remaining events of the job uncompared.
    void leave();
    /// The job has ended. The only events left on record may be those by which the coordinator switched devices off.
    void end(JobOutcome outcome);
    /// Call once, at the end of a log that continues after the last motion.
    void finish();

private:
    /// True for an event of another coordinator than the one that runs the epoch.
    bool is_heirs(const program_event_t& event) const { return event.coordinator != epoch_coordinator_; }
    bool is_the_same(const program_event_t& recorded, const PathEvent& planned);
    bool is_in_time(const program_event_t& recorded, Tick planned);
    bool is_of_rest(const program_event_t& recorded);
    bool lacks(const PathEvent& planned);
    void skip_repeats();
    void note(const PathEvent& event);

    EventFindings findings_;
    RecordedEvents recorded_;
    PlannedEvents planned_;
    KnownDevices devices_;
    SwitchedOff switched_off_{recorded_, devices_, findings_};
    std::int64_t epoch_coordinator_ = 0;
};

}  // namespace lockstep::verification
