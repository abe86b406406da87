// The first job whose beginning is in the log. If the log begins later than the record, runs and events before that job
// are left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lockstep/program_event_t.hpp>
#include <optional>

#include "clients/verification/findings.hpp"
#include "core/protocol/messages.hpp"
#include "services/record/reading/program_parts.hpp"

namespace lockstep::verification {

class FirstJob {
public:
    /// The log begins later than the record.
    void begin_late() { log_begins_late_ = true; }
    bool log_begins_late() const { return log_begins_late_; }

    /// Returns false for a record of a job that began before the log.
    bool take(const analysis::RecordedJob& record);
    /// Whether an event is the first of another job, so that the events so far are of a job that began before the log.
    bool ends_earlier_job(const program_event_t& event);

    /// Whether an epoch is of a job that began before the log, as far as is known yet.
    bool is_behind(Epoch epoch) const { return log_begins_late_ && first_epoch_ && epoch < *first_epoch_; }
    /// Likewise, if no later record follows.
    bool is_never_known(Epoch epoch) const { return log_begins_late_ && (!first_epoch_ || epoch < *first_epoch_); }
    /// Counts runs without a plan.
    void leave_out(std::size_t runs, Findings& findings);
    /// Call once, at the end of the log.
    void note(Findings& findings) const;

private:
    bool log_begins_late_ = false;
    std::size_t left_out_ = 0;  // runs of jobs that began before the log
    std::int64_t newest_event_job_ = 0;
    std::optional<std::int64_t> first_job_;
    std::optional<Epoch> first_epoch_;  // of such a job
};

}  // namespace lockstep::verification
