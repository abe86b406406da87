// Compares the recorded events of jobs with those of their programs: each once, in order, and at its place. An event in
// motion must be at the tick that planning the program again gives. An event at rest must be before the place where the
// axes rest.
#pragma once

#include <cstdint>
#include <deque>
#include <lockstep/program_event_t.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "clients/verification/findings.hpp"
#include "core/coordinator/epoch/epoch_runner.hpp"
#include "core/outputs/output_config.hpp"
#include "core/program_devices.hpp"
#include "services/record/reading/recorded_program.hpp"

namespace lockstep::verification {

class EventCheck {
public:
    explicit EventCheck(Findings& findings) : findings_(findings) {}

    void take(const program_event_t& event);
    /// Drops the events so far: their jobs began before the log.
    void forget_all() { waiting_.clear(); }
    /// The log begins later than the record, so the state of the devices is not known.
    void begins_late() { lose_devices(); }
    void lose_devices() { knows_devices_ = false; }

    /// A job begins. `program`: null if it has no events.
    void begin(std::int64_t coordinator, std::int64_t job, const std::string& label,
               std::shared_ptr<const analysis::RecordedProgram> program);
    /// Another coordinator continues the job after a takeover.
    void continue_by(std::int64_t coordinator) { coordinators_.push_back(coordinator); }
    void begin_epoch(Epoch epoch, std::int64_t coordinator);

    /// Compares the events in the frames that were run. `may_end_early`: their coordinator may have ended, or given the
    /// job up, before it published the last ones.
    void check_motion(std::span<const EpochRunner::Happened> planned, bool may_end_early);
    /// Compares events at rest: those before block `must` must have been published, those before `may` may have been.
    void check_rest(std::uint32_t must, std::uint32_t may);
    /// Leaves the remaining events of the job uncompared.
    void leave();
    /// The job has ended. The only events left on record may be those by which the coordinator switched devices off.
    void end(JobOutcome outcome);
    /// The outputs of the job's machine.
    void set_outputs(std::span<const OutputConfig> outputs) { outputs_.assign(outputs.begin(), outputs.end()); }
    /// As the events so far have left them, if they are known.
    const ProgramDevices& devices() const { return devices_; }
    bool knows_devices() const { return knows_devices_; }
    /// The machine rests, and so many pulses of the newest places were not made.
    void note_pulses(std::uint32_t left) { devices_.pulses.left = left; }
    /// Call once, at the end of a log that continues after the last motion.
    void finish();

private:
    using Whose = std::pair<std::int64_t, std::int64_t>;  // job and coordinator

    const program_event_t* next();
    void pop();
    /// True for an event of another coordinator than the one that runs the epoch.
    bool is_heirs(const program_event_t& event) const { return event.coordinator != epoch_coordinator_; }
    bool is_the_same(const program_event_t& recorded, const PathEvent& planned);
    bool is_in_time(const program_event_t& recorded, Tick planned);
    bool is_of_rest(const program_event_t& recorded);
    bool lacks(const PathEvent& planned);
    void skip_repeats();
    void forget_job();
    void note(const PathEvent& event);
    PathEvent event_at(std::uint32_t block) const;
    bool is_done() const { return !program_ || done_ == program_->events().size(); }
    std::uint32_t next_block() const { return program_->events()[done_]; }
    void check_switched_off(JobOutcome outcome);
    bool check_off(ProgramEvent::Kind kind, std::int32_t index, bool is_planned);
    void apply_later_ends(std::int64_t job);
    bool differ(const std::string& text, std::int32_t line, std::optional<Tick> expected = {},
                std::optional<Tick> seen = {});

    Findings& findings_;
    std::map<Whose, std::deque<program_event_t>> waiting_;
    bool knows_devices_ = true;
    ProgramDevices devices_;
    std::vector<OutputConfig> outputs_;
    // The job in progress:
    std::int64_t job_ = 0;
    std::string label_;
    std::vector<std::int64_t> coordinators_;  // in the order in which they ran it; empty if no job is in progress
    std::shared_ptr<const analysis::RecordedProgram> program_;
    std::size_t done_ = 0;  // so many of its events were found on record
    Epoch epoch_ = 0;       // the newest
    std::int64_t epoch_coordinator_ = 0;
};

}  // namespace lockstep::verification
