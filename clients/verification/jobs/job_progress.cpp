#include "clients/verification/jobs/job_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "clients/verification/jobs/record_text.hpp"
#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motor_inputs.hpp"
#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"
#include "core/outputs/output_levels.hpp"
#include "core/protocol/names.hpp"
#include "services/documents/machine_file.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::verification {
namespace {

/// An epoch begins at most so long after the coordinator has looked at the inputs of its probe.
constexpr double kLook_s = 2;

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
    if (job_) { epoch_.close(*job_, goes_on, lacks_events); }
    if (record.event == "begun") { return begin(record); }
    if (record.event == "epoch") { return begin_epoch(record); }
    end(record);
}

void JobProgress::lose(const OrderedRecord& record) {
    findings_.add_missing(
        fmt::format("messages of jobs are missing before {} of {}; from there on its runs are compared "
                    "only with their own records",
                    record.is_of_event ? "an event" : "\"" + record.event + "\"", number_of(record)));
    epoch_.lose();
    job_.reset();
    paused_.reset();
    if (record.event == "begun") { return; }
    job_ = CheckedJob{.coordinator = record.coordinator,
                      .number = record.job,
                      .label = number_of(record),
                      .replay = {},
                      .is_lost = true,
                      .broken = {},
                      .broken_axis = {}};
    events_.leave();
}

/// A coordinator that records a job begun by another has continued it after a takeover.
void JobProgress::note_owner(const RecordedJob& record) {
    if (!job_ || job_->number != record.job || job_->coordinator == record.coordinator) { return; }
    job_->coordinator = record.coordinator;
    events_.recorded().continue_by(record.coordinator);
    findings_.notes.push_back(job_->label + ": another coordinator has taken over and continued it");
}

void JobProgress::begin(const OrderedRecord& record) {
    const bool is_in_pause = record.may_be_in_pause() && is_run_by(record.coordinator) && !job_->is_in_pause;
    if (is_in_pause) { paused_ = std::exchange(job_, std::nullopt); }
    if (job_ && job_->coordinator == record.coordinator) {
        return differ(fmt::format("{}: the log has no end of it, though {} begins", job_->label, number_of(record)));
    }
    if (job_) {
        findings_.notes.push_back(job_->label + " has no end: another coordinator began " + number_of(record));
    }
    job_ = CheckedJob{
        .coordinator = record.coordinator, .number = record.job, .label = number_of(record) + ", " + record.kind};
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

/// The runs of an epoch are not compared, because the plan of its job is not known.
void JobProgress::leave_job_plan(Epoch epoch) {
    job_->is_lost = true;
    events_.leave();
    epochs_.lose(epoch);
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
    epoch_.begin(*job_, std::move(*start), record);
}

void JobProgress::take_overrides(const RecordedJob& record) {
    if (!epoch_.is(static_cast<Epoch>(record.epoch))) { return; }  // no axis ran a frame of it
    if (!epoch_->replay().set_overrides(static_cast<FrameNumber>(record.behind_frame),
                                        {record.feed_percent, record.rapid_percent})) {
        differ(fmt::format(
            "{}: its overrides were changed after frame {}, but frames after that had been run when it was recorded",
            job_->label, record.behind_frame));
    }
}

/// In the epoch in progress.
RecordedTouch JobProgress::touch_of(const RecordedJob& record) const {
    const EpochReplay& replay = epoch_->replay();
    const MachineConfig& machine = job_->replay->machine();
    const bool touched = record.outcome == "touched";
    const Ticks shortly{static_cast<std::int64_t>(kLook_s * machine.ticks_per_second())};
    RecordedTouch touch{.inputs = {},
                        .opens = replay.touch().opens,
                        .looked = replay.begin() - shortly,
                        .begin = replay.begin(),
                        .end = touched ? Tick{record.start_tick} : replay.end_of(epoch_->ran()),
                        .touched = touched,
                        .input = record.input(),
                        .utime = record.utime,
                        .job = job_->label};
    for (const TouchInput& input : replay.touch().any_of) {
        const MotorConfig& motor = job_->replay->kinematics().motors()[input.motor];
        const auto number = input_at(machine, motor.name, input.channel);
        if (!number) { continue; }
        touch.inputs.push_back({.name = machine.inputs[*number].name,
                                .motor = motor.name,
                                .channel = input.channel,
                                .debounce = setup_of(machine, motor).debounce[input.channel]});
    }
    return touch;
}

/// Compares the recorded places of a touch with those of the frames that were run.
void JobProgress::take_probe(const RecordedJob& record) {
    if (!is_of_job(record) || job_->is_lost || !job_->replay) { return; }
    job_->is_probed = true;
    if (epoch_.is(static_cast<Epoch>(record.epoch))) { touches_.take(touch_of(record)); }
    if (!epoch_ || record.outcome != "touched") { return; }
    if (const auto off = epoch_->rests_off_touch({record.start_tick})) {
        return differ(fmt::format("{}: behind the touch at tick {} {}", job_->label, record.start_tick, *off));
    }
    const JobReplay& replay = *job_->replay;
    const MotorPositions motors = job_->slides_of(epoch_->replay().positions_at({record.start_tick}, epoch_->ran()));
    for (AxisIndex i; i < std::min(replay.machine().axes.size(), record.start_count.size()); ++i) {
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
    CheckedJob job = *std::exchange(job_, std::exchange(paused_, std::nullopt));
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
    const auto motor = motor_named(job_->replay->machine(), name);
    if (!motor) {
        return differ(findings_.label_of(name) + " ran a frame of a machine that has no such axis", name, &run);
    }
    if (is_behind_gap && !epoch_->follows(*motor, run)) {
        findings_.add_missing(fmt::format("{}: runs before {} of epoch {} are not in the log", findings_.label_of(name),
                                          name_of(run), run.epoch));
    }
    const auto found = epoch_->compare(*motor, run, is_behind_gap);
    if (!found) {
        return epoch_.take_equal(of, *motor, [&] { return commanded(run, run.start); });
    }
    if (job_->replay->program()->failure()) { return differ("", name, &run); }
    questions_.ask_plan({findings_.label_of(name) + ": " + name_of(run) + found->text, name, found->tick_expected,
                         found->tick_seen, commanded(run, found->tick_expected.value_or(run.start))},
                        run);
    job_->is_lost = true;
    epoch_.lose();
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
        for (const MotorIndex i : motor_indices(motor_count(job_->replay->machine()))) {
            const std::string& axis = motor_name(job_->replay->machine(), i);
            const auto found = epoch_->shortfall_of(i);
            if (!found || found->kind == Shortfall::Kind::Cut || end.has_ended(axis)) { continue; }
            job_->break_off(*found, findings_);
            const std::string text = job_->label + " has no end in the log, and " + job_->broken;
            return end.lacks_runs(axis) ? findings_.add_missing(text) : differ(text, axis);
        }
        epoch_.close(*job_, false, true);
    }
    if (end.lacks_records) { return findings_.add_missing("the end of " + job_->label + " is not in the log"); }
    findings_.notes.push_back(job_->label + " has no end in the log" +
                              (job_->broken.empty() ? "; the axes are at rest" : ": " + job_->broken) +
                              (job_->replay ? "; what was run of it is as planned" : ""));
}

std::string JobProgress::commanded(const Run& run, Tick tick) const {
    if (run.epoch == 0) { return name_of(run); }
    std::string text = epochs_.label_of(run.epoch);
    if (!text.empty()) { text += ", "; }
    if (epoch_.is(run.epoch)) {
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
