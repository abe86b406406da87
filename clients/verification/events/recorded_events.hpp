// The recorded events that were not compared yet, by job and coordinator, in the order of their numbers. After a
// takeover several coordinators have events of one job: they come in the order in which these ran it.
#pragma once

#include <cstdint>
#include <deque>
#include <lockstep/program_event_t.hpp>
#include <map>
#include <utility>
#include <vector>

namespace lockstep::verification {

class RecordedEvents {
public:
    void take(const program_event_t& event) { waiting_[{event.job, event.coordinator}].push_back(event); }
    /// Drops the events so far: their jobs began before the log.
    void forget_all() { waiting_.clear(); }

    /// A job begins. The events left of the job before are dropped.
    void begin(std::int64_t job, std::int64_t coordinator);
    /// Another coordinator continues the job after a takeover.
    void continue_by(std::int64_t coordinator) { coordinators_.push_back(coordinator); }
    /// Drops the events left of the job in progress: it is over.
    void end();
    bool has_job() const { return !coordinators_.empty(); }
    bool was_taken_over() const { return coordinators_.size() > 1; }
    /// Of the coordinator that began the job.
    bool is_of_first(const program_event_t& event) const { return event.coordinator == coordinators_.front(); }

    /// The next event of the job in progress; null if there is none.
    const program_event_t* next() const;
    void pop();
    /// Removes and returns the events of earlier jobs that are not of their programs: a fault after the end of a job
    /// switches outputs off.
    std::vector<program_event_t> take_later_ends(std::int64_t job);
    /// The first event of a program that is left of this coordinator; null if there is none.
    const program_event_t* left_of(std::int64_t coordinator) const;

private:
    using Whose = std::pair<std::int64_t, std::int64_t>;  // job and coordinator

    std::map<Whose, std::deque<program_event_t>> waiting_;
    std::int64_t job_ = 0;                    // the one in progress
    std::vector<std::int64_t> coordinators_;  // in the order in which they ran it; empty if no job is in progress
};

}  // namespace lockstep::verification
