#include "clients/verification/jobs/job_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clients/verification/jobs/record_text.hpp"

namespace lockstep::verification {

// ---- Records -----------------------------------------------------------------------------------------------------

void JobCheck::take(const RecordedJob& record, bool is_behind_gap) {
    questions_.take(record, is_behind_gap);
    if (!first_job_.take(record)) { return; }
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
    if (first_job_.ends_earlier_job(event)) { events_.recorded().forget_all(); }
    events_.recorded().take(event);
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
    if (first_job_.is_behind(of.run.epoch)) { return first_job_.leave_out(1, findings_); }
    if (place(of)) { return; }
    if (waiting_.size() == kMaxWaiting && !records_.has_job()) {  // each job is recorded before its runs
        first_job_.begin_late();
        leave_out_before_first_job();
    }
    if (waiting_.size() == kMaxWaiting) {
        ask_epoch(waiting_.front(), "its runs are of an unknown epoch");
        const Epoch unknown = waiting_.front().run.epoch;
        epochs_.lose(unknown);
        const auto is_out = [&](const AxisRun& other) { return other.run.epoch == unknown; };
        first_job_.leave_out(std::erase_if(waiting_, is_out), findings_);
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
    return epochs_.is_lost(of.run.epoch) || questions_.is_silent_in(of.axis, of.run.epoch);
}

/// Handles the records up to the one that begins the run's epoch. Returns false if there is none yet.
bool JobCheck::begin_epoch_of(const Run& run) {
    const auto records = records_.up_to_epoch(run.epoch);
    for (std::size_t left = records.value_or(0); left > 0 && findings_.going(); --left) { handle_first(); }
    return records.has_value();
}

/// Returns false if the run's epoch is not known yet.
bool JobCheck::place(const AxisRun& of) {
    if (!progress_.epoch().is(of.run.epoch) && !is_left_out(of) && !begin_epoch_of(of.run)) { return false; }
    handle_turns();
    if (!findings_.going()) { return true; }
    is_left_out(of) ? first_job_.leave_out(1, findings_) : progress_.take(of);
    return true;
}

std::vector<Course> JobCheck::planned(const std::string& axis, Tick tick) {
    if (progress_.epoch()) { handle_turns(); }
    return progress_.epoch().planned(axis, tick);
}

// ---- The beginning and the end of the log --------------------------------------------------------------------------

void JobCheck::begins_late() {
    first_job_.begin_late();
    events_.devices().lose();
}

void JobCheck::leave_out_before_first_job() {
    const auto is_out = [&](const AxisRun& of) { return first_job_.is_never_known(of.run.epoch); };
    first_job_.leave_out(std::erase_if(waiting_, is_out), findings_);
}

void JobCheck::finish(LogEnd end) {
    leave_out_before_first_job();
    first_job_.note(findings_);
    while (!records_.empty() && findings_.going()) { handle_first(); }
    end.lacks_records = lacks_records_ || end.lacks_records;
    if (!waiting_.empty()) { ask_epoch(waiting_.front(), "the log has no record of its epoch, which it ran"); }
    questions_.finish(end);
    if (!progress_.has_job() && end.at_rest && !first_job_.log_begins_late() && !end.lacks_records) {
        events_.finish();
    }
    if (!progress_.has_job() || !findings_.going()) { return; }
    end.at_rest ? progress_.leave_at_rest(end) : progress_.leave_in_motion();
}

}  // namespace lockstep::verification
