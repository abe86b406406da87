#include "clients/verification/steps/axis_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "core/number_text.hpp"
#include "services/record/reading/record_end.hpp"
#include "services/record/step_batcher.hpp"

namespace lockstep::verification {
namespace {

constexpr Tick kBeginning{std::numeric_limits<std::int64_t>::min()};
constexpr Tick kNever{std::numeric_limits<std::int64_t>::max() - 1};

std::string at_tick(const std::optional<Tick>& tick, const char* otherwise) {
    return tick ? fmt::format("tick {}", tick->value) : otherwise;
}

std::string text_of(StepEdge step, std::int64_t count) {
    return fmt::format("{} to {} at tick {}", step.direction > 0 ? "forward" : "backward", count, step.tick.value);
}

std::string text_of_missing(const LeftSteps& found) {
    std::string text;
    if (found.unrecorded > 0) {
        text += "; " + plural(found.unrecorded, "step") + " before those of the next process are not in the log";
    }
    if (found.missing > 0) {
        text += "; of their course at least " + plural(found.missing, "step") + " are not in the log";
    }
    return text;
}

/// Frames of an axis's own move follow each other like those of an epoch.
bool goes_on(const Run& before, const Run& run) {
    return is_next(before, run) && before.to() == run.from && before.start + before.ticks() == run.start;
}

}  // namespace

AxisCheck::AxisCheck(std::string name, Findings& findings, Commanded commanded, Planned planned)
    : name_(std::move(name)), findings_(findings), commanded_(std::move(commanded)), planned_(std::move(planned)) {}

void AxisCheck::set_machine(const MachineConfig& machine) {
    clocks_.set_machine(machine);
    positions_.set_machine(machine);
    slot_ = machine.slot_ticks();
}

void AxisCheck::take(Run run) {
    if (!findings_.going()) { return; }
    (void)birth_of(run.incarnation);
    note_wrong(clocks_.take(name_, run), run.start);
    runs_.push_back({std::move(run), std::exchange(runs_are_missing_, false)});
    settle(false);
}

void AxisCheck::runs_missing(std::int64_t from, std::int64_t end) {
    if (!findings_.going()) { return; }
    const std::string which =
        end - from == 1 ? fmt::format("run {} is", from) : fmt::format("runs {} to {} are", from, end - 1);
    findings_.add_missing(fmt::format("{}: the record of {} not in the log, after {}", label(), which,
                                      at_tick(last_tick_, "its beginning")));
    runs_are_missing_ = true;
}

void AxisCheck::runs_contradict(const Run& other) {
    differ(fmt::format("{}: run {} is in the log twice, with different content", label(), other.sequence), {},
           other.start);
}

void AxisCheck::on_batch(const analysis::StepBatch& batch) {
    if (!findings_.going()) { return; }
    (void)birth_of(batch.incarnation);
    if (!steps_from_) { steps_from_ = batch.sequence > 0 ? batch.steps.front().tick : kBeginning; }
    note_wrong(clocks_.take(name_, batch), batch.steps.front().tick);
    note_wrong(positions_.take(batch, slot_), batch.steps.front().tick);
    waiting_.add(batch);
    if (runs_from_) { before_log_steps_ += waiting_.drop_before(runs_from_->first, runs_from_->second); }
    settle(false);
    if (waiting_.size() <= kMaxWaiting) { return; }
    findings_.add_unknown(fmt::format("{}: no run is recorded for {}", label(), waiting_text()));
    runs_gap_ = {waiting_.front().incarnation, kBeginning, kNever};
    drop_steps_of_missing_runs();
}

void AxisCheck::on_contradiction(const analysis::Contradiction& what) {
    differ(label() + ": " + sentence(what), {}, what.first);
}

void AxisCheck::on_break(const analysis::Break& what) {
    if (what.missing_batches == 0 || !findings_.going()) { return; }
    const bool is_first = !what.from && incarnations_.size() <= 1;
    positions_.skip();
    if (is_first && (marked_.empty() || what.missing_batches <= marked_.begin()->second)) { return; }  // begins later
    settle(false);
    findings_.add_missing(fmt::format("{}: {} with at least {} missing between {} and {}", label(),
                                      plural(what.missing_batches, "message"),
                                      plural(std::abs(what.position_change), "step"),
                                      at_tick(what.from, "the log's beginning"), at_tick(what.to, "the log's end")));
    const Run* run = maker_ ? &maker_->run() : last_run_ ? &*last_run_ : nullptr;
    if (run != nullptr) {
        steps_gaps_.push_back({run->incarnation, what.from.value_or(kBeginning), what.to.value_or(kNever)});
    }
}

/// Compares as far as steps and runs were received.
void AxisCheck::settle(bool log_ended) {
    while (findings_.going()) {
        if (!maker_ && !begin_next_run()) { return; }
        pass_before_log();
        pass_gap();
        drop_steps_of_missing_runs();
        if (compare_equal()) { continue; }
        const std::optional<SeenStep> front = waiting_.empty() ? std::nullopt : std::optional(waiting_.front());
        const SeenStep* seen = front ? &*front : nullptr;
        const bool may_be_over = seen != nullptr || log_ended;
        if (seen != nullptr && is_of_older_process(*seen)) {
            leave_steps();
        } else if (maker_->next() == nullptr || (may_be_over && is_cut_here(seen))) {
            end_run();
        } else if (seen == nullptr) {
            return;
        } else {
            is_of_newer_process(*seen) ? leave_run() : differ_at(*seen);
        }
    }
}

// ---- The beginning -------------------------------------------------------------------------------------------------

void AxisCheck::began_before_log(const Run& run) { before_log_ = {run.incarnation, run.sequence}; }

bool AxisCheck::is_before_log(const Run& run) const {
    return before_log_ && before_log_->first == run.incarnation && run.sequence <= before_log_->second;
}

/// The log may lack the first runs of the first process (run_stream.hpp). Their steps belong to no recorded run.
void AxisCheck::leave_out_before_log(const Run& first) {
    runs_from_ = {first.incarnation, first.start};
    before_log_steps_ += waiting_.drop_before(first.incarnation, first.start);
}

/// Skips the first steps of a run that began before the log, because the log does not contain them.
void AxisCheck::pass_before_log() {
    if (!is_before_log(maker_->run()) || !steps_from_) { return; }
    while (maker_->next() != nullptr && maker_->next()->tick < *steps_from_) { pass_step(false); }
}

// ---- Runs and steps ------------------------------------------------------------------------------------------------

bool AxisCheck::begin_next_run() {
    if (runs_.empty()) { return false; }
    const bool is_behind_gap = runs_.front().is_behind_gap;
    if (!last_run_ && runs_.front().run.sequence > 0) { leave_out_before_log(runs_.front().run); }
    maker_.emplace(std::move(runs_.front().run));
    runs_.pop_front();
    const Run& run = maker_->run();
    if (is_behind_gap && follower_ != nullptr) { follower_->on_gap(); }
    if (is_behind_gap) { runs_gap_ = {run.incarnation, kBeginning, run.start}; }
    const bool follows = last_run_ && last_run_->incarnation == run.incarnation && !is_behind_gap;
    const bool jumps = follows && last_run_->device_stop() != run.device_start();
    if (jumps && std::exchange(device_lost_, false)) {
        const std::int64_t late = waiting_.drop_before(run.incarnation, run.start);
        const std::string made = late == 0 ? "" : "; it made " + plural(late, "step") + " more, which are not compared";
        findings_.notes.push_back(
            fmt::format("{}: its device was lost after {}{}; from {} on another device counts, from {}", label(),
                        name_of(*last_run_), made, name_of(run), run.device_start()));
    } else if (jumps) {
        differ(fmt::format("{}: {} starts at count {} of the device, but the run before it ended at {}", label(),
                           name_of(run), run.device_start(), last_run_->device_stop()),
               {}, run.start);
    } else if (!run.cut && run.to().count() != run.stop_count) {
        differ(fmt::format("{}: {} is recorded to end at {}, but its pieces end at {}", label(), name_of(run),
                           run.stop_count, run.to().count()),
               {}, run.start);
    } else if (run.epoch == 0 && run.frame <= 1 && !run.tail && !starts_from_rest(run)) {
        differ(fmt::format("{}: {} does not start from rest on a whole step", label(), name_of(run)), {}, run.start);
    } else if (run.epoch == 0 && (run.frame > 1 || run.tail) && follows && !goes_on(*last_run_, run)) {
        differ(fmt::format("{}: {} does not continue the frame before it", label(), name_of(run)), {}, run.start);
    }
    if (findings_.going() && follower_ != nullptr) { follower_->on_run(run); }
    return findings_.going();
}

void AxisCheck::end_run() {
    last_run_ = maker_->run();
    maker_.reset();
    if (follower_ != nullptr) { follower_->on_run_over(); }
}

void AxisCheck::pass_step(bool is_recorded) {
    if (follower_ != nullptr) { follower_->on_step(*maker_->next(), maker_->commanded(), is_recorded); }
    maker_->pass();
}

/// A run that was cut ends at its stop count, unless the steps continue with its pieces.
bool AxisCheck::is_cut_here(const SeenStep* seen) {
    if (!maker_->run().cut || maker_->count() != maker_->run().stop_count) { return false; }
    return seen == nullptr || seen->edge != *maker_->next();
}

/// Compares many steps at once, as long as they are equal. Returns false if no step is.
bool AxisCheck::compare_equal() {
    if (!maker_ || waiting_.empty()) { return false; }
    const SeenBatch& batch = waiting_.batch();
    const auto made = maker_->ready();
    if (made.empty() || batch.incarnation() != maker_->run().incarnation || batch.count() != maker_->count()) {
        return false;
    }
    const std::size_t equal = in_time(batch, made.first(analysis::equal_steps(made, batch.edges())));
    if (equal > 0) { note_equal(equal); }
    return equal > 0;
}

void AxisCheck::note_equal(std::size_t steps) {
    last_tick_ = waiting_.batch().edges()[steps - 1].tick;
    if (follower_ != nullptr) {
        for (std::size_t i = 0; i < steps; ++i) { pass_step(true); }
    } else {
        maker_->pass(steps, waiting_.batch().count_after(steps));
        findings_.steps += static_cast<std::int64_t>(steps);
    }
    waiting_.pass(steps);
    steps_ += static_cast<std::int64_t>(steps);
    findings_.last_tick = std::max(findings_.last_tick, last_tick_);
}

/// The number of the steps, equal by the device's clock, that are also at their commanded machine times. An axis's own
/// moves follow only the device's clock.
std::size_t AxisCheck::in_time(const SeenBatch& batch, std::span<const StepEdge> steps) {
    const Run& run = maker_->run();
    if (run.epoch == 0) { return steps.size(); }
    note_wrong(clocks_.take_in_frame(run, batch.clock_error()), steps.empty() ? run.start : steps.front().tick);
    findings_.clock_error = std::max(findings_.clock_error, batch.clock_error() + run.clock_error);
    if (batch.shares_time() && run.shares_time()) { return steps.size(); }
    const Ticks most = allowed(batch.clock_error(), run.clock_error);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Tick tick = steps[i].tick;
        const Ticks late = length_of(batch.machine_time(tick) - maker_->commanded_at(tick));
        if (late > most) { return i; }
        findings_.latest = std::max(findings_.latest, late);
    }
    return steps.size();
}

/// Says why the next step in the log is not the next one of its run.
void AxisCheck::differ_at(const SeenStep& seen) {
    const StepEdge expected = *maker_->next();
    const std::int64_t count = maker_->count() + expected.direction;
    const std::string step = step_name();
    if (seen.edge.tick != expected.tick) {
        return differ(fmt::format("{} is expected at tick {}, but the log has it at tick {}", step, expected.tick.value,
                                  seen.edge.tick.value),
                      expected.tick, seen.edge.tick);
    }
    if (seen.edge.direction != expected.direction) {
        return differ(fmt::format("{} is expected to go {}, but in the log it goes the other way", step,
                                  (expected.direction > 0 ? "forward" : "backward")),
                      expected.tick, seen.edge.tick);
    }
    if (seen.count != count) {
        return differ(fmt::format("{} is expected to reach {}, but in the log it reaches {}", step, count, seen.count),
                      expected.tick, seen.edge.tick);
    }
    const Ticks error = seen.error + maker_->run().clock_error;
    differ(fmt::format("{} was made at machine time {}, commanded for {}; the uncertainty of its clocks was {}", step,
                       seen.machine.value, maker_->commanded().value, plural(error.value, "tick")),
           maker_->commanded(), seen.machine);
}

// ---- Missing messages ----------------------------------------------------------------------------------------------

/// Passes the steps whose messages are missing.
void AxisCheck::pass_gap() {
    while (!steps_gaps_.empty() && maker_ && maker_->run().incarnation == steps_gaps_.front().incarnation) {
        const Gap& gap = steps_gaps_.front();
        const StepEdge* next = maker_->next();
        if (next == nullptr || next->tick <= gap.from) { return; }
        if (next->tick >= gap.until) {
            steps_gaps_.pop_front();
        } else if (is_cut_here(nullptr)) {
            return;
        } else {
            pass_step(false);
            ++gap_steps_;
            findings_.lacks_steps = true;
        }
    }
}

/// Drops the steps of runs that are missing: they are before the next run.
void AxisCheck::drop_steps_of_missing_runs() {
    if (!runs_gap_) { return; }
    gap_run_steps_ += waiting_.drop_before(runs_gap_->incarnation, runs_gap_->until + Ticks{1});
    if (!waiting_.empty()) { runs_gap_.reset(); }
}

void AxisCheck::note_gaps() {
    if (gap_steps_ == 0 && gap_run_steps_ == 0) { return; }
    findings_.add_unknown(
        fmt::format("{}: {} of its runs are not in the log, and {} in the log are of runs that "
                    "are not; all others are compared",
                    label(), plural(gap_steps_, "step"), plural(gap_run_steps_, "step")));
}

void AxisCheck::note_wrong(const std::optional<std::string>& why, std::optional<Tick> seen) {
    if (why && findings_.going()) { differ(label() + ": " + *why, {}, seen); }
}

std::string AxisCheck::waiting_text() const {
    return fmt::format("{} from tick {} on", plural(static_cast<std::int64_t>(waiting_.size()), "step"),
                       waiting_.front().edge.tick.value);
}

// ---- Processes that ended ------------------------------------------------------------------------------------------

/// Processes are identified by their numbers, and ordered by their first messages.
std::size_t AxisCheck::birth_of(std::int64_t incarnation) {
    const auto known = std::ranges::find(incarnations_, incarnation);
    const auto birth = static_cast<std::size_t>(known - incarnations_.begin());
    if (known == incarnations_.end()) { incarnations_.push_back(incarnation); }
    return birth;
}

/// True for a step of an earlier process than the run's. Steps that a process publishes before its first run belong to
/// orders of an earlier process, too.
bool AxisCheck::is_of_older_process(const SeenStep& seen) {
    const Run& run = maker_->run();
    if (seen.incarnation != run.incarnation) { return birth_of(seen.incarnation) < birth_of(run.incarnation); }
    const bool is_first = !last_run_ || last_run_->incarnation != run.incarnation;
    return is_first && birth_of(run.incarnation) > 0 && seen.edge.tick < run.start;
}

bool AxisCheck::is_of_newer_process(const SeenStep& seen) {
    return birth_of(seen.incarnation) > birth_of(maker_->run().incarnation);
}

/// The run is recorded with its end, but its last steps are not. There may be at most as many as a process holds
/// unpublished.
void AxisCheck::leave_run() {
    if (!last_run_ || last_run_->incarnation != maker_->run().incarnation) { unrecorded_ = 0; }
    std::int64_t steps = 0;
    for (; maker_->next() != nullptr && !is_cut_here(nullptr); pass_step(false)) { ++steps; }
    unrecorded_ += steps;
    if (unrecorded_ > StepBatcher::kMaxSteps) { return differ_unrecorded(unrecorded_); }
    const std::string text =
        fmt::format("{}: {} after {} are not in the log, because its process ended; with {} it came to {}", label(),
                    plural(steps, "step"), at_tick(last_tick_, "the log's beginning"), name_of(maker_->run()),
                    maker_->run().stop_count);
    findings_.lacks_steps = findings_.lacks_steps || steps > 0;
    steps > 0 ? findings_.add_unknown(text) : findings_.notes.push_back(text);
    end_run();
}

/// The steps are recorded, but their runs are not.
void AxisCheck::leave_steps() {
    std::vector<SeenStep> left;
    for (; !waiting_.empty() && (!maker_ || is_of_older_process(waiting_.front())); waiting_.pass(1)) {
        left.push_back(waiting_.front());
    }
    check_left(left);
}

void AxisCheck::check_left(const std::vector<SeenStep>& left) {
    const std::string what =
        fmt::format("{}: {} from tick {} on belong to no run in the log, because its process ended; ", label(),
                    plural(static_cast<std::int64_t>(left.size()), "step"), left.front().edge.tick.value);
    const std::vector<Course> courses = planned_(left.front().machine);
    if (courses.empty()) { return findings_.add_unknown(what + "there is no plan to compare them with"); }
    const LeftSteps found = compare_left(
        left, courses,
        last_run_ ? LeftBy{last_run_->incarnation, last_run_->zero_count} : LeftBy{incarnations_.front(), {}});
    steps_ += static_cast<std::int64_t>(found.fit);
    findings_.steps += static_cast<std::int64_t>(found.fit);
    if (found.fit < left.size()) { return differ_from_plan(what, left[found.fit], found); }
    last_tick_ = left.back().edge.tick;
    findings_.last_tick = std::max(findings_.last_tick, last_tick_);
    if (found.unrecorded > StepBatcher::kMaxSteps) { return differ_unrecorded(found.unrecorded); }
    const std::string text = what + "they are as planned: " + found.runs + text_of_missing(found);
    const bool lacks_steps = found.missing + found.unrecorded > 0;
    findings_.lacks_steps = findings_.lacks_steps || lacks_steps;
    lacks_steps ? findings_.add_unknown(text) : findings_.notes.push_back(text);
}

void AxisCheck::differ_from_plan(const std::string& what, const SeenStep& seen, const LeftSteps& found) {
    const auto& [run, expected, count] = *found.misfit;
    const auto tick = expected ? std::optional(expected->tick) : std::nullopt;
    findings_.differ({.text = fmt::format("{}they are not as planned: after {} that are, the log has one {}, {} {}",
                                          what, found.fit, text_of(seen.edge, seen.count), name_of(*run),
                                          expected ? "has it " + text_of(*expected, count) : "has no more"),
                      .axis = name_,
                      .tick_expected = tick,
                      .tick_seen = seen.edge.tick,
                      .commanded = commanded_(*run, tick.value_or(seen.edge.tick))});
}

void AxisCheck::differ_unrecorded(std::int64_t steps) {
    differ(fmt::format("{}: {} after {} are not in the log; its process cannot have held so many when it ended",
                       label(), plural(steps, "step"), at_tick(last_tick_, "the log's beginning")),
           last_tick_, {});
}

// ---- The end -------------------------------------------------------------------------------------------------------

void AxisCheck::finish(const HasEnded& has_ended, LogEdges edges) {
    if (findings_.going()) { stream_.finish(); }
    settle(true);
    while (findings_.going() && maker_ && !steps_from_ && is_before_log(maker_->run())) {
        end_run();  // it was over before the log began
        settle(true);
    }
    while (findings_.going() && maker_ && has_ended(maker_->run().incarnation)) {
        leave_run();
        settle(true);
    }
    if (findings_.going() && !maker_ && !waiting_.empty() && is_left_at_end(has_ended)) { leave_steps(); }
    if (findings_.going()) { end_of_log(edges); }
    if (!edges.ends_early && !edges.lacks_steps) { note_wrong(positions_.finish(), last_tick_); }
    if (findings_.going()) { note_gaps(); }
    if (findings_.going() && before_log_steps_ > 0) {
        findings_.notes.push_back(
            fmt::format("{}: {} before tick {} belong to runs that ended before the log began, and are not compared",
                        label(), plural(before_log_steps_, "step"), runs_from_->second.value));
    }
    if (findings_.going() && follower_ != nullptr) { follower_->on_end(); }
}

/// True for steps that an ended process left, or that a new process found in its device before its first run.
bool AxisCheck::is_left_at_end(const HasEnded& has_ended) {
    const std::int64_t of = waiting_.front().incarnation;
    const bool has_run = last_run_ && last_run_->incarnation == of;
    return has_ended(of) || (birth_of(of) > 0 && !has_run);
}

void AxisCheck::end_of_log(LogEdges edges) {
    const std::string compared =
        fmt::format("{} up to {} compared", plural(steps_, "step"), at_tick(last_tick_, "there"));
    if (maker_ && (edges.ends_early || edges.lacks_steps)) {
        findings_.add_unknown(
            fmt::format("{}: the log ends before the last steps of {}; {}", label(), name_of(maker_->run()), compared));
        while (maker_->next() != nullptr && !is_cut_here(nullptr)) { pass_step(false); }
        end_run();
    } else if (edges.begins_late && !last_run_ && !waiting_.empty()) {
        findings_.add_unknown(fmt::format("{}: no run of it is in the log, which begins later; {} cannot be compared",
                                          label(), plural(static_cast<std::int64_t>(waiting_.size()), "step")));
    } else if (!waiting_.empty() && (edges.ends_early || edges.lacks_runs)) {
        findings_.add_unknown(fmt::format("{}: the log ends before the record of the run that {} belong to; {}",
                                          label(), waiting_text(), compared));
    } else if (maker_) {
        const Tick expected = maker_->next()->tick;
        differ(fmt::format("{}: the log has no more steps, although {} makes one at tick {}; {}", label(),
                           name_of(maker_->run()), expected.value, compared),
               expected, {});
    } else if (!waiting_.empty()) {
        differ(fmt::format("{}: {} belong to no run in the log; {}", label(), waiting_text(), compared), {},
               waiting_.front().edge.tick);
    }
}

void AxisCheck::differ(std::string text, std::optional<Tick> expected, std::optional<Tick> seen) {
    Difference found{.text = std::move(text), .axis = name_, .tick_expected = expected, .tick_seen = seen};
    const Run* run = maker_ ? &maker_->run() : last_run_ ? &*last_run_ : nullptr;
    if (run != nullptr) { found.commanded = commanded_(*run, expected.value_or(run->start)); }
    findings_.differ(std::move(found));
}

std::string AxisCheck::step_name() const { return fmt::format("{}: step {}", label(), steps_ + 1); }

}  // namespace lockstep::verification
