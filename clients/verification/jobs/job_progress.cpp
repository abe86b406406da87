#include "clients/verification/jobs/job_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clients/verification/jobs/record_text.hpp"
#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"
#include "core/outputs/output_levels.hpp"
#include "core/protocol/names.hpp"
#include "services/documents/machine_file.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::verification {
namespace {

std::size_t index_of(const MachineConfig& machine, const std::string& axis) {
    return motor_named(machine, axis).value_or(motor_count(machine));
}

JobOutcome outcome_of(const RecordedJob& record) {
    if (record.outcome == "done") { return JobOutcome::Done; }
    return record.outcome == "failed" ? JobOutcome::Failed : JobOutcome::Stopped;
}

}  // namespace

// ---- Records -----------------------------------------------------------------------------------------------------

/// A coordinator that ends or gives a job up may not have published the last events.
void JobProgress::take(const OrderedRecord& record) {
    const bool lacks_events = record.outcome == "failed" || (job_ && job_->coordinator != record.coordinator);
    if (record.event != "begun") { note_owner(record); }
    if (record.event == "override") { return take_overrides(record); }
    if (record.event == "probe") { return take_probe(record); }
    const bool goes_on = is_of_job(record) && record.event != "begun" && record.outcome != "failed";
    close_epoch(goes_on, lacks_events);
    if (record.event == "begun") { return begin(record); }
    if (record.event == "epoch") { return begin_epoch(record); }
    end(record);
}

void JobProgress::lose(const OrderedRecord& record) {
    findings_.add_missing(
        fmt::format("messages of jobs are missing before {} of {}; from there on its runs are compared "
                    "only with their own records",
                    record.is_of_event ? "an event" : "\"" + record.event + "\"", number_of(record)));
    lose_epoch();
    job_.reset();
    paused_.reset();
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
void JobProgress::lose_epoch() {
    if (!epoch_) { return; }
    note_lost(epoch_->epoch());
    epoch_.reset();
}

/// The runs of this epoch are left out.
void JobProgress::note_lost(Epoch epoch) {
    lost_epochs_.push_back(epoch);
    if (lost_epochs_.size() > kLabelsKept) { lost_epochs_.pop_front(); }
}

/// A coordinator that records a job begun by another has continued it after a takeover.
void JobProgress::note_owner(const RecordedJob& record) {
    if (!job_ || job_->number != record.job || job_->coordinator == record.coordinator) { return; }
    job_->coordinator = record.coordinator;
    events_.continue_by(record.coordinator);
    findings_.notes.push_back(job_->label + ": another coordinator has taken over and continued it");
}

/// Axes may be jogged in the pause of a job, and return in it. A homing by touch consists of moves with programs.
bool JobProgress::begins_in_pause(const OrderedRecord& record) const {
    const bool is_of_homing = record.kind == "home" && record.has_program();
    const bool may_be = record.kind == "jog" || record.kind == "return" || is_of_homing;
    return may_be && job_ && job_->coordinator == record.coordinator && !job_->is_in_pause;
}

void JobProgress::begin(const OrderedRecord& record) {
    const bool is_in_pause = begins_in_pause(record);
    if (is_in_pause) { paused_ = std::exchange(job_, std::nullopt); }
    if (job_ && job_->coordinator == record.coordinator) {
        return differ(fmt::format("{}: the log has no end of it, though {} begins", job_->label, number_of(record)));
    }
    if (job_) {
        findings_.notes.push_back(job_->label + " has no end: another coordinator began " + number_of(record));
    }
    job_ =
        Job{.coordinator = record.coordinator, .number = record.job, .label = number_of(record) + ", " + record.kind};
    job_->is_in_pause = is_in_pause;
    if (!is_in_pause) {
        paused_.reset();
        events_.begin(record.coordinator, record.job, job_->label, nullptr);
    }
    if (!record.has_program() || record.kind == "own-move") { return; }  // axes on their own make no epoch
    if (!record.lacks.empty()) {
        findings_.add_missing(job_->label + ": its program is not known: " + record.lacks);
        job_->is_lost = true;
        return is_in_pause ? void() : events_.leave();
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
    if (is_in_pause) { return; }  // a return has no events
    events_.begin(record.coordinator, record.job, job_->label, job_->replay->program());
    events_.set_outputs(machine->outputs);
    if (record.is_behind_gap) { events_.leave(); }  // events at rest may come before the job's begin
}

bool JobProgress::is_of_job(const RecordedJob& record) const {
    return job_ && job_->number == record.job && job_->coordinator == record.coordinator;
}

/// The runs of an epoch are not compared, because the plan of its job is not known.
void JobProgress::leave_job_plan(Epoch epoch) {
    job_->is_lost = true;
    events_.leave();
    note_lost(epoch);
}

void JobProgress::begin_epoch(const RecordedJob& record) {
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
    auto start = job_->replay->next(record.start_count);
    if (!start) { return differ(job_->label + " continues, though its program is done"); }
    const PathPlace place = place_in(record);
    if (place.block != start->place.block || place.along != start->place.along) {
        const std::string text =
            fmt::format("{} continues from {}; planned: {}", job_->label, text_of(place), text_of(start->place));
        if (job_->ran != FrameNumber{0}) { return differ(text); }
        questions_.ask_motion({text + ", as no run before is in the log", {}, {}, {}, job_->label});
        return leave_job_plan(epoch);
    }
    if (!job_->is_in_pause) {
        events_.check_rest(start->place.block, start->place.block);
        events_.begin_epoch(epoch, record.coordinator);
    }
    const MotorPositions at = start->at;
    job_->begun_at = at;
    job_->plays = record.start_count;
    const MachineConfig& machine = job_->replay->machine();
    ProgramDevices devices = events_.devices();
    if (job_->is_in_pause || record.kind == name_of(JobKind::Jog)) { devices.pulses = {}; }
    epoch_.emplace(machine, EpochReplay(machine, epoch, std::move(*start), overrides, {record.start_tick}, devices),
                   at);
    knows_outputs_ = events_.knows_devices();
    pulses_.clear();
    for (const OutputConfig& output : machine.outputs) {
        if (output.makes_pulses()) { pulses_.try_emplace(output.motor); }
    }
    labels_.emplace_back(epoch, job_->label);
    if (labels_.size() > kLabelsKept) { labels_.pop_front(); }
}

void JobProgress::take_overrides(const RecordedJob& record) {
    if (!epoch_ || epoch_->epoch() != static_cast<Epoch>(record.epoch)) { return; }  // no axis ran a frame of it
    if (!epoch_->replay().set_overrides(static_cast<FrameNumber>(record.behind_frame),
                                        {record.feed_percent, record.rapid_percent})) {
        differ(fmt::format(
            "{}: its overrides were changed after frame {}, but frames after that had been run when it was recorded",
            job_->label, record.behind_frame));
    }
}

MotorPositions JobProgress::Job::slides_of(MotorPositions motors) const {
    for (std::size_t m = 0; m < plays.size() && m < begun_at.size(); ++m) {
        Play play(replay->kinematics().motors()[m].backlash);
        play.set(plays[m]);
        play.follow(motors[m].count() - begun_at[m].count());
        motors[m] = motors[m] - Displacement::steps(play.steps());
    }
    return motors;
}

/// Compares the recorded places of a touch with those of the frames that were run.
void JobProgress::take_probe(const RecordedJob& record) {
    if (!is_of_job(record) || job_->is_lost || !job_->replay) { return; }
    job_->is_probed = true;
    if (!epoch_ || record.outcome != "touched") { return; }
    const JobReplay& replay = *job_->replay;
    const MotorPositions motors = job_->slides_of(epoch_->replay().positions_at({record.start_tick}, epoch_->ran()));
    for (std::size_t i = 0; i < replay.machine().axes.size() && i < record.start_count.size(); ++i) {
        const AxisConfig& axis = replay.machine().axes[i];
        const double mm = replay.kinematics().axis_steps(i, motors) / axis.steps_per_mm;
        const std::int64_t planned = std::llround(mm * kNmInMm);
        if (planned == record.start_count[i]) { continue; }
        return differ(
            fmt::format("{}: the touch at tick {} is recorded at {} {}; by the frames that were run it was at {}",
                        job_->label, record.start_tick, axis.name,
                        number_text(static_cast<double>(record.start_count[i]) / kNmInMm), number_text(mm)));
    }
}

void JobProgress::end(const RecordedJob& record) {
    if (!is_of_job(record)) {
        return differ("the log has the end of " + number_of(record) + ", but not its beginning");
    }
    Job job = *std::exchange(job_, std::exchange(paused_, std::nullopt));
    if (job.is_lost) { return; }
    if (!job.replay) { return job.is_in_pause ? void() : events_.end(outcome_of(record)); }
    if (job.is_probed) { job.replay->end_probed(); }
    const auto left = job.replay->next();
    if (record.outcome == "failed") {
        findings_.notes.push_back(fmt::format("{} failed{}; what was run of it is as planned", job.label,
                                              (job.broken.empty() ? "" : ": " + job.broken)));
    } else if (!job.broken.empty()) {
        return differ(fmt::format("{} is recorded as {}, but {}", job.label, record.outcome, job.broken),
                      job.broken_axis);
    } else if (record.outcome == "done" && job.ran == FrameNumber{0} && !job.is_probed) {
        const std::string text = job.label + " is recorded as done, but no run of its last motion is in the log";
        questions_.ask_motion({text, {}, {}, {}, job.label});
        return job.is_in_pause ? void() : events_.leave();
    } else if (record.outcome == "done" && left) {
        return differ(job.label + " is recorded as done, but its program continues at " + text_of(left->place));
    }
    ++findings_.jobs;
    if (job.is_in_pause) { return; }
    if (!job.broken.empty()) { return events_.leave(); }
    const std::uint32_t rest = job.replay->moves_from();
    events_.check_rest(record.outcome == "done" ? rest : 0, rest);
    events_.end(outcome_of(record));
}

// ---- Epochs and runs ---------------------------------------------------------------------------------------------

void JobProgress::take(const AxisRun& of) {
    const auto& [name, run, is_behind_gap] = of;
    const std::size_t axis = index_of(job_->replay->machine(), name);
    if (axis == motor_count(job_->replay->machine())) {
        return differ(findings_.label_of(name) + " ran a frame of a machine that has no such axis", name, &run);
    }
    if (is_behind_gap && !epoch_->follows(axis, run)) {
        findings_.add_missing(fmt::format("{}: runs before {} of epoch {} are not in the log", findings_.label_of(name),
                                          name_of(run), run.epoch));
    }
    const auto found = epoch_->compare(axis, run, is_behind_gap);
    if (!found) {
        ++findings_.runs;
        return note_outputs(of, axis);
    }
    if (job_->replay->program()->failure()) { return differ("", name, &run); }
    questions_.ask_plan({findings_.label_of(name) + ": " + name_of(run) + found->text, name, found->tick_expected,
                         found->tick_seen, commanded(run, found->tick_expected.value_or(run.start))},
                        run);
    job_->is_lost = true;
    lose_epoch();
}

/// Those of a run that was cut are not compared: its device made them safe.
void JobProgress::note_outputs(const AxisRun& of, std::size_t axis) {
    const Run& run = of.run;
    const Frame* const frame = epoch_->replay().frame(run.frame);
    const OutputTrack* const track = frame != nullptr ? frame->outputs_of(axis) : nullptr;
    if (track == nullptr || !on_outputs_ || !knows_outputs_ || run.cut) { return; }
    OutputCheck::Planned planned{.incarnation = run.incarnation,
                                 .begin = run.start,
                                 .end = run.start + run.ticks(),
                                 .changes = {},
                                 .ticks = run.tail ? total_ticks(frame->axes[axis].tail) : frame->ticks,
                                 .is_retimed = !run.commanded_ticks.empty(),
                                 .clock_error = run.clock_error,
                                 .commanded = commanded(run, run.start),
                                 .pulses = {}};
    const auto take = [&](const auto& changes) { planned.changes.assign(changes.begin(), changes.end()); };
    run.tail ? take(track->tail) : take(track->body);
    if (const auto pulses = pulses_.find(of.axis); pulses != pulses_.end()) {
        if (of.is_behind_gap) { pulses->second.lose(); }
        std::vector<OutputChange> made = planned.changes;
        for (OutputChange& change : made) { change.at = planned.tick_of(change) - planned.begin; }
        planned.pulses = pulses->second.events_of({run, std::move(made), run.tail || frame->last});
    }
    on_outputs_(of.axis, std::move(planned));
}

/// Compares the epoch's end, and takes the state of the job after it.
void JobProgress::close_epoch(bool goes_on, bool lacks_events) {
    if (!epoch_) { return; }
    plan_next(epoch_->replay());
    job_->ran = epoch_->ran();
    const std::size_t axes = motor_count(job_->replay->machine());
    std::optional<Shortfall> found = epoch_->shortfall();
    for (std::size_t i = 0; goes_on && i < axes && found && suspect(*found); ++i) { found = epoch_->shortfall(); }
    found ? break_off(*found) : check_epoch(lacks_events);
    epoch_.reset();
}

/// If an axis has nothing more in the log, its runs may be missing. The epoch is then taken for complete, if others ran
/// further; the axis's next run shows whether runs are missing.
bool JobProgress::suspect(const Shortfall& shortfall) {
    const std::string& axis = motor_name(job_->replay->machine(), shortfall.axis);
    if (shortfall.kind != Shortfall::Kind::Silent) { return false; }
    const FrameNumber most = epoch_->ran();
    if (!epoch_->assume_complete(shortfall.axis)) { return false; }
    questions_.ask_silence(axis, epoch_->epoch(),
                           {.text = fmt::format("{} {}, though {} went on to frame {}", findings_.label_of(axis),
                                                shortfall.text, job_->label, most),
                            .axis = axis,
                            .tick_expected = {},
                            .tick_seen = {},
                            .commanded = job_->label});
    return true;
}

/// Takes the state of the job after an epoch that all axes ran to its end.
void JobProgress::check_epoch(bool lacks_events) {
    const EpochEnd end = epoch_->end();
    const bool is_whole = end.kind == EpochEnd::Kind::Complete;
    const std::uint32_t rests_before = is_whole ? epoch_->replay().source()->end().block : end.place.block;
    job_->replay->ended(end, epoch_->replay().source());
    if (job_->is_in_pause) { return; }
    events_.check_motion(epoch_->replay().take_events(end.ran), lacks_events);
    events_.check_rest(lacks_events ? 0 : rests_before, job_->replay->moves_from());
    if (end.ran > 0) { note_pulses(); }
}

/// How many are left decides what the next epoch begins with.
void JobProgress::note_pulses() {
    for (const OutputConfig& output : job_->replay->machine().outputs) {
        if (!output.makes_pulses() || !is_active(output, events_.devices())) { continue; }
        const auto& left = pulses_.at(output.motor).left();
        left ? events_.note_pulses(*left) : events_.lose_devices();
    }
}

void JobProgress::break_off(const Shortfall& shortfall) {
    job_->broken_axis = motor_name(job_->replay->machine(), shortfall.axis);
    job_->broken = findings_.label_of(job_->broken_axis) + " " + shortfall.text;
}

// ---- The end of the log ------------------------------------------------------------------------------------------

void JobProgress::leave_in_motion() {
    if (epoch_ && !job_->is_in_pause) { events_.check_motion(epoch_->replay().take_events(epoch_->ran()), true); }
    const auto& last = findings_.last_tick;
    findings_.add_unknown(fmt::format("the log ends before {} does; the steps up to {} are compared", job_->label,
                                      last ? fmt::format("tick {}", last->value) : "there"));
}

/// Handles a job without an end, although all axes have come to rest, or their processes have ended.
void JobProgress::leave_at_rest(const LogEnd& end) {
    if (job_->replay && epoch_) {
        for (std::size_t i = 0; i < motor_count(job_->replay->machine()); ++i) {
            const std::string& axis = motor_name(job_->replay->machine(), i);
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

// ---- For the comparison of steps ---------------------------------------------------------------------------------

/// Plans what each axis may run after its newest run.
void JobProgress::plan_next(EpochReplay replay) {
    const std::vector<std::string> motors = motor_names(job_->replay->machine());
    for (std::size_t i = 0; i < motors.size(); ++i) { planned_[motors[i]] = epoch_->courses_of(i, replay); }
}

/// A copy of the replay makes the frames ahead, because the epoch's own frames may still be planned differently.
std::vector<Course> JobProgress::planned(const std::string& axis, Tick tick) {
    if (epoch_) { plan_next(epoch_->replay()); }
    const auto found = planned_.find(axis);
    if (found == planned_.end() || found->second.empty()) { return {}; }
    const Run& last = found->second.back().back();
    return tick < last.start + last.ticks() ? found->second : std::vector<Course>{};
}

std::string JobProgress::commanded(const Run& run, Tick tick) const {
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
void JobProgress::differ(std::string text, const std::string& axis, const Run* run) {
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
