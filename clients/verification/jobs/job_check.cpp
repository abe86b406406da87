#include "clients/verification/jobs/job_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/verification/jobs/record_text.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep::verification {
namespace {

std::size_t index_of(const MachineConfig& machine, const std::string& axis) {
    return static_cast<std::size_t>(std::ranges::find(machine.axes, axis, &AxisConfig::name) - machine.axes.begin());
}

}  // namespace

// ---- Records -----------------------------------------------------------------------------------------------------

/// Late records of a stopped coordinator's job are sorted before the job that another coordinator has begun since.
void JobCheck::take(const RecordedJob& record, bool is_behind_gap) {
    questions_.take(record, is_behind_gap);
    if (begins_late_ && !first_job_ && record.event != "begun") { return; }  // of a job begun before the log
    if (record.event == "begun" && !first_job_) { first_job_ = record.job; }
    if (record.event == "epoch" && !first_epoch_) {
        first_epoch_ = static_cast<Epoch>(record.epoch);
        leave_out_before_first_job();
    }
    auto behind = records_.end();
    if (is_late(record)) {
        const auto own = std::ranges::find(records_, record.coordinator, &Record::coordinator);
        behind = std::find_if(own == behind ? records_.begin() : own, behind, [&](const Record& r) {
            return r.event == "begun" && r.coordinator != record.coordinator;
        });
    }
    records_.insert(behind, Record{record, is_behind_gap, false});
    if (record.event == "begun") { begun_.emplace_back(record.coordinator, record.job); }
    if (begun_.size() > kLabelsKept) { begun_.pop_front(); }
    std::deque<AxisRun> waiting;
    waiting.swap(waiting_);
    for (AxisRun& of : waiting) { wait(std::move(of)); }
}

/// Missing records before an event may be of the job as well as events.
void JobCheck::take(const program_event_t& event, bool is_behind_gap) {
    if (is_behind_gap) {
        RecordedJob gap;
        gap.coordinator = event.coordinator;
        gap.job = event.job;
        records_.push_back(Record{gap, true, true});
    }
    if (begins_late_ && !first_job_ && event.job != newest_event_job_) { events_.forget_all(); }
    newest_event_job_ = event.job;
    events_.take(event);
}

void JobCheck::begins_late() {
    begins_late_ = true;
    events_.begins_late();
}

/// A coordinator that ends or gives a job up may not have published the last events.
void JobCheck::handle(const Record& record) {
    if (record.is_behind_gap) { lose_job(record); }
    if (record.is_of_event || is_outdated(record)) { return; }
    const bool lacks_events = record.outcome == "failed" || (job_ && job_->coordinator != record.coordinator);
    if (record.event != "begun") { note_owner(record); }
    if (record.event == "override") { return turn(record); }
    const bool goes_on = is_of_job(record) && record.event != "begun" && record.outcome != "failed";
    close_epoch(goes_on, lacks_events);
    if (record.event == "begun") { return begin(record); }
    if (record.event == "epoch") { return begin_epoch(record); }
    end(record);
}

/// Records before this one are missing. From here on the plan of the job is not known.
void JobCheck::lose_job(const Record& record) {
    findings_.add_missing(
        fmt::format("messages of jobs are missing before {} of {}; from there on its runs are compared "
                    "only with their own records",
                    record.is_of_event ? "an event" : "\"" + record.event + "\"", number_of(record)));
    lacks_records_ = true;
    lose_epoch();
    job_.reset();
    if (record.event == "begun") { return; }
    job_ = Job{.coordinator = record.coordinator,
               .number = record.job,
               .label = number_of(record),
               .replay = {},
               .is_lost = true,
               .broken = {},
               .broken_axis = {}};
    events_.leave();
}

/// The further runs of the epoch in progress are not compared with its plan.
void JobCheck::lose_epoch() {
    if (!epoch_) { return; }
    note_lost(epoch_->epoch());
    epoch_.reset();
}

/// The runs of this epoch are left out.
void JobCheck::note_lost(Epoch epoch) {
    lost_epochs_.push_back(epoch);
    if (lost_epochs_.size() > kLabelsKept) { lost_epochs_.pop_front(); }
}

void JobCheck::contradict(const JobRecord& other) {
    std::visit(
        [this](const auto& record) {
            differ(fmt::format("message {} of jobs is in the log twice, with different content; it is of job {}",
                               record.sequence, record.job));
        },
        other);
}

/// A record of a job by its coordinator, after another coordinator began a job.
bool JobCheck::is_late(const RecordedJob& record) const {
    const auto its = std::ranges::find(begun_, std::pair{record.coordinator, record.job});
    return record.event != "begun" && its != begun_.end() && begun_.back().first != record.coordinator;
}

/// True for a late record of an epoch that no axis ran: with a run of it, the record would have been handled before.
bool JobCheck::is_outdated(const RecordedJob& record) {
    const bool is_its_turn = !job_ || job_->coordinator == record.coordinator;
    if (is_its_turn || !is_late(record)) { return false; }
    findings_.notes.push_back(number_of(record) + ": its coordinator records more of it after another began " +
                              job_->label + "; nothing was run of that");
    return true;
}

/// A coordinator that records a job begun by another has continued it after a takeover.
void JobCheck::note_owner(const RecordedJob& record) {
    if (!job_ || job_->number != record.job || job_->coordinator == record.coordinator) { return; }
    job_->coordinator = record.coordinator;
    events_.continue_by(record.coordinator);
    findings_.notes.push_back(job_->label + ": another coordinator has taken over and continued it");
}

void JobCheck::begin(const Record& record) {
    if (job_ && job_->coordinator == record.coordinator) {
        return differ(job_->label + ": the log has no end of it, though " + number_of(record) + " begins");
    }
    if (job_) {
        findings_.notes.push_back(job_->label + " has no end: another coordinator began " + number_of(record));
    }
    job_ =
        Job{.coordinator = record.coordinator, .number = record.job, .label = number_of(record) + ", " + record.kind};
    events_.begin(record.coordinator, record.job, job_->label, nullptr);
    if (!record.has_program() || record.kind == "own-move") { return; }  // axes on their own make no epoch
    if (!record.lacks.empty()) {
        findings_.add_missing(job_->label + ": its program is not known: " + record.lacks);
        job_->is_lost = true;
        return events_.leave();
    }
    const auto machine = parse_machine(record.config);
    const auto program = record.read_program();
    if (!machine || !program) {
        findings_.unreadable = number_of(record) + (machine ? ": its program: " + program.error()
                                                            : to_text(": its configuration", machine.error()));
        return;
    }
    job_->label += " " + (*program)->head().name;
    auto replay = JobReplay::plan(*machine, *program, record.start_count);
    if (!replay) { return differ(job_->label + ": it cannot be planned again: " + replay.error()); }
    job_->replay = std::move(*replay);
    events_.begin(record.coordinator, record.job, job_->label, job_->replay->program());
    if (record.is_behind_gap) { events_.leave(); }  // events at rest may come before the job's begin
}

bool JobCheck::is_of_job(const RecordedJob& record) const {
    return job_ && job_->number == record.job && job_->coordinator == record.coordinator;
}

/// The runs of an epoch are not compared, because the plan of its job is not known.
void JobCheck::leave_job_plan(Epoch epoch) {
    job_->is_lost = true;
    events_.leave();
    note_lost(epoch);
}

void JobCheck::begin_epoch(const RecordedJob& record) {
    const auto epoch = static_cast<Epoch>(record.epoch);
    if (is_of_job(record) && job_->is_lost) { return leave_job_plan(epoch); }
    if (is_of_job(record) && !job_->replay) {
        return differ("the log has an epoch of " + number_of(record) + ", which has no program");
    }
    if (!is_of_job(record)) {
        return differ("the log has an epoch of " + number_of(record) + ", but not the beginning of that job");
    }
    if (!job_->broken.empty()) { return differ(job_->label + " continues, though " + job_->broken, job_->broken_axis); }
    const Overrides overrides{record.feed_percent, record.rapid_percent};
    auto start = job_->replay->next();
    if (!start) { return differ(job_->label + " continues, though its program is done"); }
    const PathPlace place = place_in(record);
    if (place.block != start->place.block || place.along != start->place.along) {
        const std::string text =
            job_->label + " continues from " + text_of(place) + "; planned: " + text_of(start->place);
        if (job_->ran != FrameNumber{0}) { return differ(text); }
        questions_.ask_motion({text + ", as no run before is in the log", {}, {}, {}, job_->label});
        return leave_job_plan(epoch);
    }
    events_.check_rest(start->place.block, start->place.block);
    events_.begin_epoch(epoch, record.coordinator);
    const AxisPositions at = start->at;
    const MachineConfig& machine = job_->replay->machine();
    epoch_.emplace(machine, EpochReplay(machine, epoch, std::move(*start), overrides, {record.start_tick}), at);
    labels_.emplace_back(epoch, job_->label);
    if (labels_.size() > kLabelsKept) { labels_.pop_front(); }
}

void JobCheck::turn(const RecordedJob& record) {
    if (!epoch_ || epoch_->epoch() != static_cast<Epoch>(record.epoch)) { return; }  // no axis ran a frame of it
    if (!epoch_->replay().turn(static_cast<FrameNumber>(record.behind_frame),
                               {record.feed_percent, record.rapid_percent})) {
        differ(fmt::format(
            "{}: its overrides were changed after frame {}, but frames after that had been run when it was recorded",
            job_->label, record.behind_frame));
    }
}

/// Handles the overrides changed in the epoch in progress. They are recorded before any affected frame runs.
void JobCheck::handle_turns() {
    while (!records_.empty() && records_.front().event == "override") {
        handle(records_.front());
        records_.pop_front();
    }
}

void JobCheck::end(const RecordedJob& record) {
    if (!is_of_job(record)) {
        return differ("the log has the end of " + number_of(record) + ", but not its beginning");
    }
    if (job_->is_lost) { return job_.reset(); }
    Job job = *std::exchange(job_, std::nullopt);
    if (!job.replay) { return events_.end(record.outcome == "done"); }
    const auto left = job.replay->next();
    if (record.outcome == "failed") {
        findings_.notes.push_back(job.label + " failed" + (job.broken.empty() ? "" : ": " + job.broken) +
                                  "; what was run of it is as planned");
    } else if (!job.broken.empty()) {
        return differ(job.label + " is recorded as " + record.outcome + ", but " + job.broken, job.broken_axis);
    } else if (record.outcome == "done" && job.ran == FrameNumber{0}) {
        const std::string text = job.label + " is recorded as done, but no run of its last motion is in the log";
        questions_.ask_motion({text, {}, {}, {}, job.label});
        return events_.leave();
    } else if (record.outcome == "done" && left) {
        return differ(job.label + " is recorded as done, but its program continues at " + text_of(left->place));
    }
    ++findings_.jobs;
    if (!job.broken.empty()) { return events_.leave(); }
    const std::uint32_t rest = job.replay->moves_from();
    events_.check_rest(record.outcome == "done" ? rest : 0, rest);
    events_.end(record.outcome == "done");
}

/// Compares the epoch's end, and takes the state of the job after it.
void JobCheck::close_epoch(bool goes_on, bool lacks_events) {
    if (!epoch_) { return; }
    plan_next(epoch_->replay());
    job_->ran = epoch_->ran();
    const std::size_t axes = job_->replay->machine().axes.size();
    std::optional<Shortfall> found = epoch_->shortfall();
    for (std::size_t i = 0; goes_on && i < axes && found && suspect(*found); ++i) { found = epoch_->shortfall(); }
    found ? break_off(*found) : check_epoch(lacks_events);
    epoch_.reset();
}

/// If an axis has nothing more in the log, its runs may be missing. The epoch is then taken for complete, if others ran
/// further; the axis's next run shows whether runs are missing.
bool JobCheck::suspect(const Shortfall& shortfall) {
    const std::string& axis = job_->replay->machine().axes[shortfall.axis].name;
    if (shortfall.kind != Shortfall::Kind::Silent) { return false; }
    const FrameNumber most = epoch_->ran();
    if (!epoch_->assume_complete(shortfall.axis)) { return false; }
    questions_.ask_silence(
        axis, epoch_->epoch(),
        {.text = fmt::format("axis {} {}, though {} went on to frame {}", axis, shortfall.text, job_->label, most),
         .axis = axis,
         .tick_expected = {},
         .tick_seen = {},
         .commanded = job_->label});
    return true;
}

/// Takes the state of the job after an epoch that all axes ran to its end.
void JobCheck::check_epoch(bool lacks_events) {
    const EpochEnd end = epoch_->end();
    const bool is_whole = end.kind == EpochEnd::Kind::Complete;
    const std::uint32_t rests_before = is_whole ? epoch_->replay().source()->end().block : end.place.block;
    job_->replay->ended(end, epoch_->replay().source());
    events_.check_motion(epoch_->replay().take_events(end.ran), lacks_events);
    events_.check_rest(lacks_events ? 0 : rests_before, job_->replay->moves_from());
}

void JobCheck::break_off(const Shortfall& shortfall) {
    job_->broken_axis = job_->replay->machine().axes[shortfall.axis].name;
    job_->broken = "axis " + job_->broken_axis + " " + shortfall.text;
}

void JobCheck::finish(LogEnd end) {
    leave_out_before_first_job();
    if (begins_late_) { note_beginning(); }
    for (; !records_.empty() && findings_.going(); records_.pop_front()) { handle(records_.front()); }
    end.lacks_records = lacks_records_ = lacks_records_ || end.lacks_records;
    if (!waiting_.empty()) { ask_epoch(waiting_.front(), "the log has no record of its epoch, which it ran"); }
    questions_.finish(end);
    if (!job_ && end.at_rest && !begins_late_ && !lacks_records_) { events_.finish(); }
    if (!job_ || !findings_.going()) { return; }
    if (end.at_rest) { return leave_job(end); }
    check_events_so_far();
    const auto& last = findings_.last_tick;
    findings_.add_unknown(fmt::format("the log ends before {} does; the steps up to {} are compared", job_->label,
                                      last ? fmt::format("tick {}", last->value) : "there"));
}

/// Checks the events of the epoch in progress at the end of the log.
void JobCheck::check_events_so_far() {
    if (epoch_) { events_.check_motion(epoch_->replay().take_events(epoch_->ran()), true); }
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

/// Handles a job without an end, although all axes have come to rest, or their processes have ended.
void JobCheck::leave_job(const LogEnd& end) {
    if (job_->replay && epoch_) {
        for (std::size_t i = 0; i < job_->replay->machine().axes.size(); ++i) {
            const std::string& axis = job_->replay->machine().axes[i].name;
            const auto found = epoch_->shortfall_of(i);
            if (!found || found->kind == Shortfall::Kind::Cut || end.has_ended(axis)) { continue; }
            break_off(*found);
            const std::string text = job_->label + " has no end in the log, and " + job_->broken;
            return end.lacks_runs(axis) ? findings_.add_missing(text) : differ(text, axis);
        }
        close_epoch(false, true);
    }
    if (end.lacks_records) { return findings_.add_missing("the end of " + job_->label + " is not in the log"); }
    findings_.notes.push_back(job_->label + " has no end in the log" +
                              (job_->broken.empty() ? "; the axes are at rest" : ": " + job_->broken) +
                              (job_->replay ? "; what was run of it is as planned" : ""));
}

// ---- Runs --------------------------------------------------------------------------------------------------------

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
    if (waiting_.size() == kMaxWaiting && begun_.empty()) {  // each job is recorded before its runs
        begins_late_ = true;
        leave_out_before_first_job();
    }
    if (waiting_.size() == kMaxWaiting) {
        ask_epoch(waiting_.front(), "its runs are of an unknown epoch");
        note_lost(waiting_.front().run.epoch);
        leave_out(
            std::erase_if(waiting_, [&](const AxisRun& other) { return other.run.epoch == lost_epochs_.back(); }));
    }
    waiting_.push_back(std::move(of));
}

void JobCheck::ask_epoch(const AxisRun& of, const std::string& why) {
    const std::string text = fmt::format("axis {}, epoch {}: {}", of.axis, of.run.epoch, why);
    questions_.ask_epoch({text, of.axis, {}, of.run.start, commanded(of.run, of.run.start)});
}

/// Returns false if the run's epoch is not known yet.
bool JobCheck::place(const AxisRun& of) {
    const auto begins_it = [&](const Record& record) {
        return record.event == "epoch" && static_cast<Epoch>(record.epoch) == of.run.epoch;
    };
    const auto is_lost = [&] {
        return std::ranges::find(lost_epochs_, of.run.epoch) != lost_epochs_.end() ||
               questions_.is_silent_in(of.axis, of.run.epoch);
    };
    if ((!epoch_ || epoch_->epoch() != of.run.epoch) && !is_lost()) {
        const auto found = std::ranges::find_if(records_, begins_it);
        if (found == records_.end()) { return false; }
        for (auto left = found - records_.begin() + 1; left > 0 && findings_.going(); --left) {
            const Record record = std::move(records_.front());
            records_.pop_front();
            handle(record);
        }
    }
    handle_turns();
    if (!findings_.going()) { return true; }
    if (is_lost()) {
        leave_out(1);
    } else {
        compare(of);
    }
    return true;
}

void JobCheck::compare(const AxisRun& of) {
    const auto& [name, run, is_behind_gap] = of;
    const std::size_t axis = index_of(job_->replay->machine(), name);
    if (axis == job_->replay->machine().axes.size()) {
        return differ("axis " + name + " ran a frame of a machine that has no such axis", name, &run);
    }
    if (is_behind_gap && !epoch_->follows(axis, run)) {
        findings_.add_missing(
            fmt::format("axis {}: runs before {} of epoch {} are not in the log", name, name_of(run), run.epoch));
    }
    const auto found = epoch_->compare(axis, run, is_behind_gap);
    if (!found) { return void(++findings_.runs); }
    if (job_->replay->program()->failure()) { return differ("", name, &run); }
    questions_.ask_plan({"axis " + name + ": " + name_of(run) + found->text, name, found->tick_expected,
                         found->tick_seen, commanded(run, found->tick_expected.value_or(run.start))},
                        run);
    job_->is_lost = true;
    lose_epoch();
}

/// Plans what each axis may run after its newest run.
void JobCheck::plan_next(EpochReplay replay) {
    const auto& axes = job_->replay->machine().axes;
    for (std::size_t i = 0; i < axes.size(); ++i) { planned_[axes[i].name] = epoch_->courses_of(i, replay); }
}

/// A copy of the replay makes the frames ahead, because the epoch's own frames may still be planned differently.
std::vector<Course> JobCheck::planned(const std::string& axis, Tick tick) {
    if (epoch_) {
        handle_turns();
        plan_next(epoch_->replay());
    }
    const auto found = planned_.find(axis);
    if (found == planned_.end() || found->second.empty()) { return {}; }
    const Run& last = found->second.back().back();
    return tick < last.start + last.ticks() ? found->second : std::vector<Course>{};
}

std::string JobCheck::commanded(const Run& run, Tick tick) const {
    if (run.epoch == 0) { return name_of(run); }
    std::string text;
    for (const auto& [epoch, label] : labels_) {
        if (epoch == run.epoch) { text = label + ", "; }
    }
    if (epoch_ && epoch_->epoch() == run.epoch) {
        const std::int32_t line = job_->replay->line_of(epoch_->replay().block_at(tick + run.ahead));
        if (line != 0) { text += fmt::format("line {}, ", line); }
    }
    return text + fmt::format("epoch {}, {}", run.epoch, name_of(run));
}

/// If a program cannot be read any more, its plan proves nothing about the record.
void JobCheck::differ(std::string text, const std::string& axis, const Run* run) {
    if (job_ && job_->replay && job_->replay->program()->failure()) {
        findings_.unreadable = job_->label + ": its program: " + *job_->replay->program()->failure();
        return;
    }
    findings_.differ({std::move(text),
                      axis,
                      {},
                      run != nullptr ? std::optional(run->start) : std::nullopt,
                      run != nullptr ? commanded(*run, run->start)
                      : job_         ? job_->label
                                     : ""});
}

}  // namespace lockstep::verification
