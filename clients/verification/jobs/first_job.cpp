#include "clients/verification/jobs/first_job.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace lockstep::verification {

bool FirstJob::take(const analysis::RecordedJob& record) {
    if (record.event == "begun" && !first_job_) { first_job_ = record.job; }
    if (log_begins_late_ && !first_job_) { return false; }
    if (record.event == "epoch" && !first_epoch_) { first_epoch_ = static_cast<Epoch>(record.epoch); }
    return true;
}

bool FirstJob::ends_earlier_job(const program_event_t& event) {
    return std::exchange(newest_event_job_, event.job) != event.job && log_begins_late_ && !first_job_;
}

void FirstJob::leave_out(std::size_t runs, Findings& findings) {
    left_out_ += runs;
    findings.local_runs += static_cast<std::int64_t>(runs);
}

void FirstJob::note(Findings& findings) const {
    if (!log_begins_late_) { return; }
    const std::string late = "the log begins later than the record";
    if (first_job_) {
        findings.notes.push_back(
            fmt::format("{}: the result applies from job {} on; earlier runs are compared only with their own records",
                        late, *first_job_));
    } else if (left_out_ > 0) {
        findings.add_unknown(late + ", and no job begins in it: runs are compared only with their own records");
    } else {
        findings.notes.push_back(late + ", and no job begins in it");
    }
}

}  // namespace lockstep::verification
