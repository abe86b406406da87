#include "clients/verification/job_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/verification/run_difference.hpp"
#include "core/protocol/frame_room.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep::verification {
namespace {

PathPlace place_in(const RecordedJob& record) {
    const Int128 along = Int128{record.resume_high} * kOneStep + Int128{static_cast<std::uint64_t>(record.resume_low)};
    return {static_cast<std::uint32_t>(record.resume_block), {along}};
}

std::string text_of(const PathPlace& place) {
    return fmt::format("block {}, {:f} mm along it", place.block, place.along.as_steps());
}

std::string number_of(const RecordedJob& record) { return fmt::format("job {}", record.job); }

std::size_t index_of(const MachineConfig& machine, const std::string& axis) {
    return static_cast<std::size_t>(std::ranges::find(machine.axes, axis, &AxisConfig::name) - machine.axes.begin());
}

/// Returns the planned run, in machine time. `clock_error`: the tolerance of each step.
Run planned_run(const Frame& frame, std::size_t axis, bool tail, Ticks clock_error) {
    const AxisTrack& track = frame.axes[axis];
    Run run{.epoch = frame.epoch,
            .frame = frame.number,
            .start = frame.start,
            .from = track.from,
            .pieces = {},
            .clock_error = clock_error};
    run.pieces.assign(track.body.begin(), track.body.end());
    if (!tail) { return run; }
    run.tail = true;
    run.from = run.to();
    run.start += frame.ticks;
    run.pieces.assign(track.tail.begin(), track.tail.end());
    return run;
}

}  // namespace

// ---- Records -----------------------------------------------------------------------------------------------------

/// Late records of a stopped coordinator's job are sorted before the job that another coordinator has begun since.
void JobCheck::take(const RecordedJob& record) {
    if (begins_late_ && !first_job_ && record.event != "begun") { return; }  // of a job begun before the log
    if (record.event == "begun" && !first_job_) {
        first_job_ = record.job;
        leave_out_before_first_job();
    }
    if (record.event == "epoch" && !first_epoch_) { first_epoch_ = static_cast<Epoch>(record.epoch); }
    auto behind = records_.end();
    if (is_late(record)) {
        const auto own = std::ranges::find(records_, record.coordinator, &RecordedJob::coordinator);
        behind = std::find_if(own == behind ? records_.begin() : own, behind, [&](const RecordedJob& r) {
            return r.event == "begun" && r.coordinator != record.coordinator;
        });
    }
    records_.insert(behind, record);
    if (record.event == "begun") { begun_.emplace_back(record.coordinator, record.job); }
    if (begun_.size() > kLabelsKept) { begun_.pop_front(); }
    std::deque<std::pair<std::string, Run>> waiting;
    waiting.swap(waiting_);
    for (const auto& [axis, run] : waiting) { take(axis, run); }
}

void JobCheck::take(const program_event_t& event) {
    if (begins_late_ && !first_job_ && event.job != newest_event_job_) { events_.forget_all(); }
    newest_event_job_ = event.job;
    events_.take(event);
}

void JobCheck::begins_late() {
    begins_late_ = true;
    events_.begins_late();
}

/// A coordinator that ends or gives a job up may not have published the last events.
void JobCheck::handle(const RecordedJob& record) {
    if (is_outdated(record)) { return; }
    const bool lacks_events = record.outcome == "failed" || (job_ && job_->coordinator != record.coordinator);
    if (record.event != "begun") { note_owner(record); }
    if (record.event == "override") { return turn(record); }
    close_epoch(lacks_events);
    if (record.event == "begun") { return begin(record); }
    if (record.event == "epoch") { return begin_epoch(record); }
    end(record);
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

void JobCheck::begin(const RecordedJob& record) {
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
    if (!record.lacks.empty()) { return differ(job_->label + ": its program is not known: " + record.lacks); }
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
}

bool JobCheck::is_of_job(const RecordedJob& record) const {
    return job_ && job_->number == record.job && job_->coordinator == record.coordinator;
}

void JobCheck::begin_epoch(const RecordedJob& record) {
    if (!is_of_job(record) || !job_->replay) {
        return differ("the log has an epoch of " + number_of(record) + ", but not the beginning of that job");
    }
    if (!job_->broken.empty()) { return differ(job_->label + " continues, though " + job_->broken, job_->broken_axis); }
    const Overrides overrides{record.feed_percent, record.rapid_percent};
    auto start = job_->replay->next();
    if (!start) { return differ(job_->label + " continues, though its program is done"); }
    const PathPlace place = place_in(record);
    if (place.block != start->place.block || place.along != start->place.along) {
        return differ(job_->label + " continues from " + text_of(place) + "; planned: " + text_of(start->place));
    }
    events_.check_rest(start->place.block, start->place.block);
    events_.begin_epoch(static_cast<Epoch>(record.epoch), record.coordinator);
    std::vector<Progress> axes;
    for (const Position at : start->at) { axes.push_back({.at = at}); }
    const auto epoch = static_cast<Epoch>(record.epoch);
    epoch_.emplace(EpochReplay(job_->replay->machine(), epoch, std::move(*start), overrides, {record.start_tick}),
                   std::move(axes));
    labels_.emplace_back(epoch, job_->label);
    if (labels_.size() > kLabelsKept) { labels_.pop_front(); }
}

void JobCheck::turn(const RecordedJob& record) {
    if (!epoch_ || epoch_->replay.epoch() != static_cast<Epoch>(record.epoch)) { return; }  // no axis ran a frame of it
    if (!epoch_->replay.turn(static_cast<FrameNumber>(record.behind_frame),
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
    Job job = *std::exchange(job_, std::nullopt);
    if (!job.replay) { return events_.end(record.outcome == "done"); }
    const auto left = job.replay->next();
    if (record.outcome == "failed") {
        findings_.notes.push_back(job.label + " failed" + (job.broken.empty() ? "" : ": " + job.broken) +
                                  "; what was run of it is as planned");
    } else if (!job.broken.empty()) {
        return differ(job.label + " is recorded as " + record.outcome + ", but " + job.broken, job.broken_axis);
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
void JobCheck::close_epoch(bool lacks_events) {
    if (!epoch_) { return; }
    plan_next(epoch_->replay);
    bool whole = true;
    for (std::size_t i = 0; i < epoch_->axes.size() && whole; ++i) { whole = !breaks_off(i); }
    if (whole) { check_epoch(lacks_events); }
    epoch_.reset();
}

/// Returns true, and notes why, if the axis did not run its last frame and tail to their end.
bool JobCheck::breaks_off(std::size_t i) {
    const Progress& axis = epoch_->axes[i];
    const std::string frame = fmt::format("frame {}", axis.ran);
    if (axis.cut) {
        break_off(i, "was stopped early in " + frame);
        return true;
    }
    if (axis.ran == 0 || axis.in_tail) { return false; }
    const Frame* last = epoch_->replay.frame(axis.ran);
    if (last == nullptr || last->last || last->axes[i].tail.empty()) { return false; }
    break_off(i, "has nothing in the log after " + frame + ", which is not its last");
    return true;
}

/// Uses the coordinator's own evaluation of where the axes came to rest.
void JobCheck::check_epoch(bool lacks_events) {
    std::vector<AxisEnd> ends;
    for (const Progress& axis : epoch_->axes) { ends.push_back({axis.ran, axis.at}); }
    const EpochEnd end = epoch_->replay.evaluate(ends);
    switch (end.kind) {
        case EpochEnd::Kind::FramesDiffer: return break_off(end.axis, "ran other frames than the rest");
        case EpochEnd::Kind::Misplaced: return break_off(end.axis, "is not where its frames end");
        case EpochEnd::Kind::Complete:
        case EpochEnd::Kind::Interrupted: break;
    }
    const bool is_whole = end.kind == EpochEnd::Kind::Complete;
    const std::uint32_t rests_before = is_whole ? epoch_->replay.source()->end().block : end.place.block;
    job_->replay->ended(end, epoch_->replay.source());
    events_.check_motion(epoch_->replay.take_events(end.ran), lacks_events);
    events_.check_rest(lacks_events ? 0 : rests_before, job_->replay->moves_from());
}

void JobCheck::break_off(std::size_t axis, const std::string& why) {
    job_->broken_axis = job_->replay->machine().axes[axis].name;
    job_->broken = "axis " + job_->broken_axis + " " + why;
}

void JobCheck::finish(bool at_rest, const HasEnded& has_ended) {
    leave_out_before_first_job();
    if (begins_late_) { note_beginning(); }
    for (; !records_.empty() && findings_.going(); records_.pop_front()) { handle(records_.front()); }
    if (!waiting_.empty()) {
        const auto& [axis, run] = waiting_.front();
        differ(fmt::format("axis {}: the log has no record of epoch {}, which it ran", axis, run.epoch), axis, &run);
    }
    if (!job_ && at_rest && !begins_late_) { events_.finish(); }
    if (!job_ || !findings_.going()) { return; }
    if (at_rest) { return leave_job(has_ended); }
    check_events_so_far();
    const auto& last = findings_.last_tick;
    findings_.add_unknown(fmt::format("the log ends before {} does; the steps up to {} are compared", job_->label,
                                      last ? fmt::format("tick {}", last->value) : "there"));
}

/// Checks the events of the epoch in progress at the end of the log.
void JobCheck::check_events_so_far() {
    if (!epoch_) { return; }
    FrameNumber ran = 0;
    for (const Progress& axis : epoch_->axes) { ran = std::max(ran, axis.ran); }
    events_.check_motion(epoch_->replay.take_events(ran), true);
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
void JobCheck::leave_job(const HasEnded& has_ended) {
    if (job_->replay) {
        for (std::size_t i = 0; epoch_ && i < epoch_->axes.size(); ++i) {
            const std::string& axis = job_->replay->machine().axes[i].name;
            if (!breaks_off(i) || epoch_->axes[i].cut || has_ended(axis)) { continue; }
            return differ(job_->label + " has no end in the log, and " + job_->broken, axis);
        }
        if (epoch_) { job_->broken.clear(); }
        close_epoch(true);
    }
    findings_.notes.push_back(job_->label + " has no end in the log" +
                              (job_->broken.empty() ? "; the axes are at rest" : ": " + job_->broken) +
                              (job_->replay ? "; what was run of it is as planned" : ""));
}

// ---- Runs --------------------------------------------------------------------------------------------------------

bool JobCheck::is_before_first_job(const Run& run) const {
    return begins_late_ && (!first_job_ || (first_epoch_ && run.epoch < *first_epoch_));
}

/// Counts them as runs without a plan.
void JobCheck::leave_out(std::size_t runs) {
    left_out_ += runs;
    findings_.local_runs += static_cast<std::int64_t>(runs);
}

void JobCheck::leave_out_before_first_job() {
    if (!begins_late_) { return; }
    const auto is_out = [&](const auto& waiting) { return is_before_first_job(waiting.second) || !first_epoch_; };
    leave_out(std::erase_if(waiting_, is_out));
}

void JobCheck::take(const std::string& axis, const Run& run) {
    if (!findings_.going()) { return; }
    if (is_before_first_job(run)) { return leave_out(1); }
    if (place(axis, run)) { return; }
    if (waiting_.size() == kMaxWaiting && begun_.empty()) {  // each job is recorded before its runs
        begins_late_ = true;
        leave_out_before_first_job();
    }
    if (waiting_.size() == kMaxWaiting) { return differ("axis " + axis + ": runs of an unknown epoch", axis, &run); }
    waiting_.emplace_back(axis, run);
}

/// Returns false if the run's epoch is not known yet.
bool JobCheck::place(const std::string& axis, const Run& run) {
    const auto begins_it = [&](const RecordedJob& record) {
        return record.event == "epoch" && static_cast<Epoch>(record.epoch) == run.epoch;
    };
    if (!epoch_ || epoch_->replay.epoch() != run.epoch) {
        const auto found = std::ranges::find_if(records_, begins_it);
        if (found == records_.end()) { return false; }
        for (auto left = found - records_.begin() + 1; left > 0 && findings_.going(); --left) {
            handle(records_.front());
            records_.pop_front();
        }
        if (!findings_.going()) { return true; }
    }
    handle_turns();
    if (!findings_.going()) { return true; }
    const std::size_t i = index_of(job_->replay->machine(), axis);
    if (i < epoch_->axes.size()) {
        compare(i, axis, run);
    } else {
        differ("axis " + axis + " ran a frame of a machine that has no such axis", axis, &run);
    }
    return true;
}

void JobCheck::compare(std::size_t axis, const std::string& name, const Run& run) {
    Progress& progress = epoch_->axes[axis];
    if (const std::string why = out_of_order(progress, run); !why.empty()) {
        return differ("axis " + name + ": " + name_of(run) + why, name, &run);
    }
    const Frame* frame = epoch_->replay.frame(run.frame);
    if (frame == nullptr) { return differ("axis " + name + ": the plan has no " + name_of(run), name, &run); }
    const Run planned = planned_run(*frame, axis, run.tail, run.clock_error);
    const auto found = has_own_clocks() ? compare_retimed(planned, run, progress.end) : compare_runs(planned, run);
    if (found) {
        return findings_.differ({"axis " + name + ": " + name_of(run) + " " + found->text, name, found->tick_expected,
                                 found->tick_seen, commanded(run, found->tick_expected.value_or(run.start))});
    }
    progress = {run.frame, run.tail, run.cut, run.cut ? Position::steps(run.stop_count) : run.to(),
                run.start + run.ticks()};
    ++findings_.runs;
    epoch_->replay.forget_before(std::ranges::min_element(epoch_->axes, {}, &Progress::ran)->ran);
}

/// Plans what each axis may run after its newest run.
void JobCheck::plan_next(EpochReplay replay) {
    for (std::size_t i = 0; i < epoch_->axes.size(); ++i) {
        planned_[job_->replay->machine().axes[i].name] = courses_of(replay, i);
    }
}

/// Each course has further frames, or none, and then the tail of the last frame, or the path's end if it has no tail.
/// Before its process ended, an axis may have run or armed, without a record, the frame in motion and all frames that
/// were sent ahead.
std::vector<Course> JobCheck::courses_of(EpochReplay& replay, std::size_t axis) const {
    const Progress& progress = epoch_->axes[axis];
    std::vector<Course> courses;
    if (progress.cut || progress.in_tail) { return courses; }
    Course frames;
    const auto unrecorded = static_cast<FrameNumber>(frames_ahead(job_->replay->machine().timing)) + 1;
    for (FrameNumber number = progress.ran; number <= progress.ran + unrecorded; ++number) {
        const Frame* frame = number > 0 ? replay.frame(number) : nullptr;
        if (number > progress.ran && frame == nullptr) { break; }
        if (number > progress.ran) { frames.push_back(planned_run(*frame, axis, false, known_within())); }
        Course course = frames;
        if (frame != nullptr) { course.push_back(planned_run(*frame, axis, true, known_within())); }
        if (!course.empty()) { courses.push_back(std::move(course)); }
    }
    return courses;
}

/// A copy of the replay makes the frames ahead, because the epoch's own frames may still be planned differently.
std::vector<Course> JobCheck::planned(const std::string& axis, Tick tick) {
    if (epoch_) {
        handle_turns();
        plan_next(epoch_->replay);
    }
    const auto found = planned_.find(axis);
    if (found == planned_.end() || found->second.empty()) { return {}; }
    const Run& last = found->second.back().back();
    return tick < last.start + last.ticks() ? found->second : std::vector<Course>{};
}

/// Returns an empty text if the run follows the axis's previous one.
std::string JobCheck::out_of_order(const Progress& axis, const Run& run) const {
    const std::string after = fmt::format(" follows frame {}", axis.ran);
    if (axis.cut || axis.in_tail) { return after + ", with which the epoch had ended"; }
    const FrameNumber next = run.tail ? axis.ran : axis.ran + 1;
    return run.frame == next && run.frame > 0 ? "" : after;
}

std::string JobCheck::commanded(const Run& run, Tick tick) const {
    if (run.epoch == 0) { return name_of(run); }
    std::string text;
    for (const auto& [epoch, label] : labels_) {
        if (epoch == run.epoch) { text = label + ", "; }
    }
    if (epoch_ && epoch_->replay.epoch() == run.epoch) {
        const std::int32_t line = job_->replay->line_of(epoch_->replay.block_at(tick + run.ahead));
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
