#include "clients/verification/jobs/job_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clients/verification/jobs/record_text.hpp"

namespace lockstep::verification {

// ---- Records -----------------------------------------------------------------------------------------------------

void JobCheck::take(const RecordedJob& record, bool is_behind_gap) {
    questions_.take(record, is_behind_gap);
    if (begins_late_ && !first_job_ && record.event != "begun") { return; }  // of a job begun before the log
    if (record.event == "begun" && !first_job_) { first_job_ = record.job; }
    if (record.event == "epoch" && !first_epoch_) {
        first_epoch_ = static_cast<Epoch>(record.epoch);
        leave_out_before_first_job();
    }
    records_.add({record, is_behind_gap, false});
    place_waiting();
}

/// Missing records before an event may be of the job as well as events.
void JobCheck::take(const program_event_t& event, bool is_behind_gap) {
    if (is_behind_gap) {
        RecordedJob gap;
        gap.coordinator = event.coordinator;
        gap.job = event.job;
        records_.add({gap, true, true});
    }
    if (begins_late_ && !first_job_ && event.job != newest_event_job_) { events_.forget_all(); }
    newest_event_job_ = event.job;
    events_.take(event);
}

void JobCheck::contradict(const JobRecord& other) {
    std::visit(
        [this](const auto& record) {
            progress_.differ(
                fmt::format("message {} of jobs is in the log twice, with different content; it is of job {}",
                            record.sequence, record.job));
        },
        other);
}

void JobCheck::handle(const OrderedRecord& record) {
    lacks_records_ = lacks_records_ || record.is_behind_gap;
    if (record.is_behind_gap) { progress_.lose(record); }
    if (!record.is_of_event && !is_outdated(record)) { progress_.take(record); }
}

void JobCheck::handle_first() {
    const OrderedRecord record = records_.take();
    handle(record);
}

/// Handles the overrides changed in the epoch in progress. They are recorded before any affected frame runs.
void JobCheck::handle_turns() {
    while (!records_.empty() && records_.front().event == "override") { handle_first(); }
}

/// True for a late record of an epoch that no axis ran: with a run of it, the record would have been handled before.
bool JobCheck::is_outdated(const RecordedJob& record) {
    const bool is_its_turn = !progress_.has_job() || progress_.is_run_by(record.coordinator);
    if (is_its_turn || !records_.is_late(record)) { return false; }
    findings_.notes.push_back(
        fmt::format("{}: its coordinator records more of it after another began {}; nothing was run of that",
                    number_of(record), progress_.label()));
    return true;
}

// ---- Runs --------------------------------------------------------------------------------------------------------

void JobCheck::take(const std::string& axis, const Run& run, bool is_behind_gap) {
    if (!findings_.going()) { return; }
    questions_.take(axis, run, is_behind_gap);
    if (run.epoch == 0) { return void(++findings_.local_runs); }
    wait({axis, run, is_behind_gap});
}

/// Compares the run, or keeps it until its epoch is known.
void JobCheck::wait(AxisRun of) {
    if (!findings_.going()) { return; }
    if (is_before_first_job(of.run)) { return leave_out(1); }
    if (place(of)) { return; }
    if (waiting_.size() == kMaxWaiting && !records_.has_job()) {  // each job is recorded before its runs
        begins_late_ = true;
        leave_out_before_first_job();
    }
    if (waiting_.size() == kMaxWaiting) {
        ask_epoch(waiting_.front(), "its runs are of an unknown epoch");
        const Epoch unknown = waiting_.front().run.epoch;
        progress_.note_lost(unknown);
        leave_out(std::erase_if(waiting_, [&](const AxisRun& other) { return other.run.epoch == unknown; }));
    }
    waiting_.push_back(std::move(of));
}

void JobCheck::place_waiting() {
    std::deque<AxisRun> waiting;
    waiting.swap(waiting_);
    for (AxisRun& of : waiting) { wait(std::move(of)); }
}

void JobCheck::ask_epoch(const AxisRun& of, const std::string& why) {
    const std::string text = fmt::format("{}, epoch {}: {}", findings_.label_of(of.axis), of.run.epoch, why);
    questions_.ask_epoch({text, of.axis, {}, of.run.start, commanded(of.run, of.run.start)});
}

bool JobCheck::is_left_out(const AxisRun& of) const {
    return progress_.is_lost(of.run.epoch) || questions_.is_silent_in(of.axis, of.run.epoch);
}

/// Handles the records up to the one that begins the run's epoch. Returns false if there is none yet.
bool JobCheck::begin_epoch_of(const Run& run) {
    const auto records = records_.up_to_epoch(run.epoch);
    for (std::size_t left = records.value_or(0); left > 0 && findings_.going(); --left) { handle_first(); }
    return records.has_value();
}

/// Returns false if the run's epoch is not known yet.
bool JobCheck::place(const AxisRun& of) {
    if (!progress_.is_in_epoch(of.run.epoch) && !is_left_out(of) && !begin_epoch_of(of.run)) { return false; }
    handle_turns();
    if (!findings_.going()) { return true; }
    is_left_out(of) ? leave_out(1) : progress_.take(of);
    return true;
}

std::vector<Course> JobCheck::planned(const std::string& axis, Tick tick) {
    if (progress_.has_epoch()) { handle_turns(); }
    return progress_.planned(axis, tick);
}

// ---- The beginning and the end of the log --------------------------------------------------------------------------

void JobCheck::begins_late() {
    begins_late_ = true;
    events_.begins_late();
}

bool JobCheck::is_before_first_job(const Run& run) const {
    return begins_late_ && first_epoch_ && run.epoch < *first_epoch_;
}

/// Counts them as runs without a plan.
void JobCheck::leave_out(std::size_t runs) {
    left_out_ += runs;
    findings_.local_runs += static_cast<std::int64_t>(runs);
}

void JobCheck::leave_out_before_first_job() {
    if (!begins_late_) { return; }
    const auto is_out = [&](const AxisRun& of) { return is_before_first_job(of.run) || !first_epoch_; };
    leave_out(std::erase_if(waiting_, is_out));
}

void JobCheck::finish(LogEnd end) {
    leave_out_before_first_job();
    if (begins_late_) { note_beginning(); }
    while (!records_.empty() && findings_.going()) { handle_first(); }
    end.lacks_records = lacks_records_ || end.lacks_records;
    if (!waiting_.empty()) { ask_epoch(waiting_.front(), "the log has no record of its epoch, which it ran"); }
    questions_.finish(end);
    if (!progress_.has_job() && end.at_rest && !begins_late_ && !end.lacks_records) { events_.finish(); }
    if (!progress_.has_job() || !findings_.going()) { return; }
    end.at_rest ? progress_.leave_at_rest(end) : progress_.leave_in_motion();
}

void JobCheck::note_beginning() {
    const std::string late = "the log begins later than the record";
    if (first_job_) {
        findings_.notes.push_back(
            fmt::format("{}: the result applies from job {} on; earlier runs are compared only with their own records",
                        late, *first_job_));
    } else if (left_out_ > 0) {
        findings_.add_unknown(late + ", and no job begins in it: runs are compared only with their own records");
    } else {
        findings_.notes.push_back(late + ", and no job begins in it");
    }
}

}  // namespace lockstep::verification
