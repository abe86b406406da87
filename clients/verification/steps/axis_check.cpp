#include "clients/verification/steps/axis_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/number_text.hpp"
#include "services/record/reading/record_end.hpp"

namespace lockstep::verification {
namespace {

/// Frames of an axis's own move follow each other like those of an epoch.
bool goes_on(const Run& before, const Run& run) {
    return is_next(before, run) && before.to() == run.from && before.start + before.ticks() == run.start;
}

/// Why the record of a run contradicts itself, or the run before; empty if it does not. `before`: null if that is not
/// in the log.
std::string contradiction_of(const Run& run, const Run* before) {
    const std::string name = name_of(run);
    if (before != nullptr && before->device_stop() != run.device_start()) {
        return fmt::format("{} starts at count {} of the device, but the run before it ended at {}", name,
                           run.device_start(), before->device_stop());
    }
    if (!run.cut && run.to().count() != run.stop_count) {
        return fmt::format("{} is recorded to end at {}, but its pieces end at {}", name, run.stop_count,
                           run.to().count());
    }
    if (run.epoch != 0) { return ""; }
    const bool is_first = run.frame <= 1 && !run.tail;
    if (is_first && !starts_from_rest(run)) { return name + " does not start from rest on a whole step"; }
    if (!is_first && before != nullptr && !goes_on(*before, run)) {
        return name + " does not continue the frame before it";
    }
    return "";
}

void differ_if(const std::optional<std::string>& why, const ComparedRun& run, std::optional<Tick> seen,
               AxisFindings& findings) {
    if (why && findings.going()) { findings.differ(*why, run.newest(), {}, seen); }
}

/// The number of the steps, equal by the device's clock, that are also at their commanded machine times. An axis's own
/// moves follow only the device's clock.
std::size_t in_time(const SeenBatch& batch, const StepSpan& steps, ComparedRun& compared, const ClockCheck& clocks,
                    AxisFindings& findings) {
    const Run& run = compared.run();
    if (run.epoch == 0) { return steps.size(); }
    differ_if(clocks.take_in_frame(run, batch.clock_error()), compared, steps.empty() ? run.start : steps.front().tick,
              findings);
    Findings& all = findings.all();
    all.clock_error = std::max(all.clock_error, batch.clock_error() + run.clock_error);
    if (batch.shares_time() && run.shares_time()) { return steps.size(); }
    const Ticks most = allowed(batch.clock_error(), run.clock_error);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Tick tick = steps.tick(i);
        const Ticks late = length_of(batch.machine_time(tick) - compared->commanded_at(tick));
        if (late > most) { return i; }
        all.latest = std::max(all.latest, late);
    }
    return steps.size();
}

void pass_equal(std::size_t steps, WaitingSteps& waiting, ComparedRun& run, AxisFindings& findings) {
    const SeenBatch& batch = waiting.batch();
    findings.add_equal(steps, batch.edges().tick(steps - 1));
    if (run.has_follower()) {
        for (std::size_t i = 0; i < steps; ++i) { run.pass_step(true); }
    } else {
        run->pass(steps, batch.count_after(steps));
        findings.all().steps += static_cast<std::int64_t>(steps);
    }
    waiting.pass(steps);
}

/// Compares many steps at once, as long as they are equal. Returns false if no step is.
bool compare_equal(WaitingSteps& waiting, ComparedRun& run, const ClockCheck& clocks, AxisFindings& findings) {
    if (waiting.empty()) { return false; }
    const SeenBatch& batch = waiting.batch();
    const StepSpan made = run->ready();
    if (made.empty() || batch.incarnation() != run.run().incarnation || batch.count() != run->count()) { return false; }
    const std::size_t equal =
        in_time(batch, made.first(analysis::equal_steps(made, batch.edges())), run, clocks, findings);
    if (equal > 0) { pass_equal(equal, waiting, run, findings); }
    return equal > 0;
}

/// Says why the next step in the log is not the next one of its run.
void differ_at(const SeenStep& seen, ComparedRun& run, AxisFindings& findings) {
    const StepEdge expected = *run->next();
    const std::int64_t count = run->count() + expected.direction;
    const std::string step = fmt::format("step {}", findings.steps() + 1);
    const auto differ = [&](const std::string& text) {
        findings.differ(text, &run.run(), expected.tick, seen.edge.tick);
    };
    if (seen.edge.tick != expected.tick) {
        return differ(fmt::format("{} is expected at tick {}, but the log has it at tick {}", step, expected.tick.value,
                                  seen.edge.tick.value));
    }
    if (seen.edge.direction != expected.direction) {
        return differ(fmt::format("{} is expected to go {}, but in the log it goes the other way", step,
                                  (expected.direction > 0 ? "forward" : "backward")));
    }
    if (seen.count != count) {
        return differ(fmt::format("{} is expected to reach {}, but in the log it reaches {}", step, count, seen.count));
    }
    const Ticks error = seen.error + run.run().clock_error;
    findings.differ(
        fmt::format("{} was made at machine time {}, commanded for {}; the uncertainty of its clocks was {}", step,
                    seen.machine.value, run->commanded().value, plural(error.value, "tick")),
        &run.run(), run->commanded(), seen.machine);
}

std::string text_of(const WaitingSteps& waiting) {
    return fmt::format("{} from tick {} on", plural(static_cast<std::int64_t>(waiting.size()), "step"),
                       waiting.front().edge.tick.value);
}

void report(const std::vector<ZeroCheck::Change>& untold, AxisFindings& findings) {
    for (const ZeroCheck::Change& moved : untold) {
        if (!findings.going()) { return; }
        if (!moved.why_unknown.empty()) {
            findings.add_unknown(moved.text + "; " + moved.why_unknown);
            continue;
        }
        findings.differ(fmt::format("{}; nothing on record moves its zero by {:+}", moved.text, moved.change), {},
                        moved.span.to, moved.commanded);
    }
}

}  // namespace

AxisCheck::AxisCheck(std::string name, Findings& findings, AxisFindings::Commanded commanded,
                     EndedProcess::Planned planned)
    : findings_(std::move(name), findings, std::move(commanded)), ended_(findings_, run_, std::move(planned)) {}

void AxisCheck::set_machine(const MachineConfig& machine) {
    clocks_.set_machine(machine);
    zero_.set_machine(machine, findings_.axis());
    zeros_.set_machine(machine);
    slot_ = machine.slot_ticks();
}

void AxisCheck::take(const analysis::RecordedPosition& position) {
    zeros_.take(position);
    if (!position.has_fault) { positions_.take(position); }
}

void AxisCheck::take(Run run) {
    if (!findings_.going()) { return; }
    processes_.take(run.incarnation);
    differ_if(clocks_.take(findings_.axis(), run), run_, run.start, findings_);
    runs_.push_back({std::move(run), std::exchange(runs_are_missing_, false)});
    settle(false);
}

void AxisCheck::runs_missing(std::int64_t from, std::int64_t end) {
    if (!findings_.going()) { return; }
    const std::string which =
        end - from == 1 ? fmt::format("run {} is", from) : fmt::format("runs {} to {} are", from, end - 1);
    findings_.add_missing(fmt::format("the record of {} not in the log, after {}", which,
                                      at_tick(findings_.last_tick(), "its beginning")));
    runs_are_missing_ = true;
}

void AxisCheck::runs_contradict(const Run& other) {
    findings_.differ(fmt::format("run {} is in the log twice, with different content", other.sequence), run_.newest(),
                     {}, other.start);
}

void AxisCheck::on_batch(const analysis::StepBatch& batch) {
    if (!findings_.going()) { return; }
    processes_.take(batch.incarnation);
    beginning_.take(batch);
    const Tick first = batch.steps.front().tick;
    differ_if(clocks_.take(findings_.axis(), batch), run_, first, findings_);
    differ_if(positions_.take(batch, slot_), run_, first, findings_);
    waiting_.add(batch);
    beginning_.drop(waiting_);
    settle(false);
    if (waiting_.size() <= kMaxWaiting) { return; }
    findings_.add_unknown("no run is recorded for " + text_of(waiting_));
    gaps_.add_runs(waiting_.front().incarnation, {});
    gaps_.drop(waiting_);
}

void AxisCheck::on_contradiction(const analysis::Contradiction& what) {
    findings_.differ(sentence(what), run_.newest(), {}, what.first);
}

void AxisCheck::on_break(const analysis::Break& what) {
    if (what.missing_batches == 0 || !findings_.going()) { return; }
    const bool is_first = !what.from && !processes_.has_changed();
    positions_.skip();
    if (is_first && (marked_.empty() || what.missing_batches <= marked_.begin()->second)) { return; }  // begins later
    settle(false);
    findings_.add_missing(fmt::format("{} with at least {} missing between {} and {}",
                                      plural(what.missing_batches, "message"),
                                      plural(std::abs(what.position_change), "step"),
                                      at_tick(what.from, "the log's beginning"), at_tick(what.to, "the log's end")));
    if (const Run* const run = run_.newest()) { gaps_.add_steps(run->incarnation, what.from, what.to); }
}

/// Compares as far as steps and runs were received.
void AxisCheck::settle(bool log_ended) {
    while (findings_.going()) {
        if (!run_ && !begin_next_run()) { return; }
        beginning_.pass(run_);
        gaps_.pass(run_, findings_.all());
        gaps_.drop(waiting_);
        if (compare_equal(waiting_, run_, clocks_, findings_)) { continue; }
        const std::optional<SeenStep> front = waiting_.empty() ? std::nullopt : std::optional(waiting_.front());
        const SeenStep* seen = front ? &*front : nullptr;
        const bool may_be_over = seen != nullptr || log_ended;
        if (seen != nullptr && is_of_older_process(*seen)) {
            leave_steps();
        } else if (run_->next() == nullptr || (may_be_over && run_.is_cut_here(seen))) {
            run_.end();
        } else if (seen == nullptr) {
            return;
        } else if (processes_.is_older(run_.run().incarnation, seen->incarnation)) {
            ended_.leave_run();
        } else {
            differ_at(*seen, run_, findings_);
        }
    }
}

bool AxisCheck::begin_next_run() {
    if (runs_.empty()) { return false; }
    const bool is_behind_gap = runs_.front().is_behind_gap;
    run_.begin(std::move(runs_.front().run), is_behind_gap);
    runs_.pop_front();
    const Run& run = run_.run();
    if (!run_.before() && run.sequence > 0) {
        beginning_.begin_at(run);
        beginning_.drop(waiting_);
    }
    if (is_behind_gap) { gaps_.add_runs(run.incarnation, run.start); }
    const bool follows = run_.before() && run_.before()->incarnation == run.incarnation && !is_behind_gap;
    const Run* const before = follows ? &*run_.before() : nullptr;
    const bool jumps = follows && before->device_stop() != run.device_start();
    if (jumps && std::exchange(device_lost_, false)) {
        const std::int64_t late = waiting_.drop_before(run.incarnation, run.start);
        const std::string made = late == 0 ? "" : "; it made " + plural(late, "step") + " more, which are not compared";
        findings_.note(fmt::format("its device was lost after {}{}; from {} on another device counts, from {}",
                                   name_of(*before), made, name_of(run), run.device_start()));
    } else if (const std::string why = contradiction_of(run, before); !why.empty()) {
        findings_.differ(why, &run, {}, run.start);
    }
    if (run_.before() && !is_behind_gap && !jumps && !run_.has_follower()) {
        zeros_.take(*run_.before(), run, [&] { return findings_.commanded(run, run.start); });
    }
    if (findings_.going()) { run_.accept(); }
    return findings_.going();
}

// ---- Processes that ended ------------------------------------------------------------------------------------------

/// True for a step of an earlier process than the run's. Steps that a process publishes before its first run belong to
/// orders of an earlier process, too.
bool AxisCheck::is_of_older_process(const SeenStep& seen) {
    const Run& run = run_.run();
    if (seen.incarnation != run.incarnation) { return processes_.is_older(seen.incarnation, run.incarnation); }
    const bool is_first = !run_.before() || run_.before()->incarnation != run.incarnation;
    return is_first && !processes_.is_first(run.incarnation) && seen.edge.tick < run.start;
}

/// True for steps that an ended process left, or that a new process found in its device before its first run.
bool AxisCheck::is_left_at_end(const HasEnded& has_ended) {
    const std::int64_t of = waiting_.front().incarnation;
    const bool has_run = run_.before() && run_.before()->incarnation == of;
    return has_ended(of) || (!processes_.is_first(of) && !has_run);
}

void AxisCheck::leave_steps() {
    std::vector<SeenStep> left;
    for (; !waiting_.empty() && (!run_ || is_of_older_process(waiting_.front())); waiting_.pass(1)) {
        left.push_back(waiting_.front());
    }
    ended_.leave_steps(left, processes_.first());
}

// ---- The end -------------------------------------------------------------------------------------------------------

void AxisCheck::finish(const HasEnded& has_ended, LogEdges edges, const HomingJobs& homings) {
    if (findings_.going()) { stream_.finish(); }
    settle(true);
    while (findings_.going() && run_ && beginning_.is_over(run_.run())) {
        run_.end();
        settle(true);
    }
    while (findings_.going() && run_ && has_ended(run_.run().incarnation)) {
        ended_.leave_run();
        settle(true);
    }
    if (findings_.going() && !run_ && !waiting_.empty() && is_left_at_end(has_ended)) { leave_steps(); }
    if (findings_.going()) { end_of_log(edges); }
    if (!edges.ends_early && !edges.lacks_steps) {
        differ_if(positions_.finish(), run_, findings_.last_tick(), findings_);
    }
    report(zeros_.finish(homings, edges.lacks_jobs), findings_);
    if (findings_.going()) { gaps_.note(findings_); }
    if (!findings_.going()) { return; }
    beginning_.note(findings_);
    run_.finish();
}

void AxisCheck::end_of_log(LogEdges edges) {
    const std::string compared =
        fmt::format("{} up to {} compared", plural(findings_.steps(), "step"), at_tick(findings_.last_tick(), "there"));
    if (run_ && (edges.ends_early || edges.lacks_steps)) {
        findings_.add_unknown(
            fmt::format("the log ends before the last steps of {}; {}", name_of(run_.run()), compared));
        (void)run_.pass_unrecorded();
        run_.end();
    } else if (edges.begins_late && !run_.before() && !waiting_.empty()) {
        findings_.add_unknown(fmt::format("no run of it is in the log, which begins later; {} cannot be compared",
                                          plural(static_cast<std::int64_t>(waiting_.size()), "step")));
    } else if (!waiting_.empty() && (edges.ends_early || edges.lacks_runs)) {
        findings_.add_unknown(fmt::format("the log ends before the record of the run that {} belong to; {}",
                                          text_of(waiting_), compared));
    } else if (run_) {
        const Tick expected = run_->next()->tick;
        findings_.differ(fmt::format("the log has no more steps, although {} makes one at tick {}; {}",
                                     name_of(run_.run()), expected.value, compared),
                         run_.newest(), expected, {});
    } else if (!waiting_.empty()) {
        findings_.differ(fmt::format("{} belong to no run in the log; {}", text_of(waiting_), compared), run_.newest(),
                         {}, waiting_.front().edge.tick);
    }
}

}  // namespace lockstep::verification
