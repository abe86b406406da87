#include "clients/verification/axis_check.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "services/wire/step_batcher.hpp"

namespace lockstep::verification {
namespace {

std::string at_tick(const std::optional<Tick>& tick, const char* otherwise) {
    return tick ? "tick " + std::to_string(tick->value) : otherwise;
}

std::string plural(std::int64_t count, const std::string& one) {
    return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

Ticks amount(Ticks ticks) { return {std::abs(ticks.value)}; }

/// What a step may be off: what is known of when it was made, and what was known when it was commanded. Two ticks are
/// for what rounding makes of it.
Ticks allowed(Ticks made, Ticks commanded) {
    constexpr Ticks kRounding{2};
    const Ticks both = made + commanded;
    return both == Ticks{} ? both : both + kRounding;
}

/// Frames of an axis's own move follow each other as those of an epoch do.
bool goes_on(const Run& before, const Run& run) {
    return is_next(before, run) && before.to() == run.from && before.start + before.ticks() == run.start;
}

}  // namespace

AxisCheck::AxisCheck(std::string name, Findings& findings, Commanded commanded, Planned planned)
    : name_(std::move(name)), findings_(findings), commanded_(std::move(commanded)), planned_(std::move(planned)) {}

void AxisCheck::take(Run run) {
    if (!findings_.going()) { return; }
    (void)birth_of(run.incarnation);
    runs_.push_back(std::move(run));
    settle(false);
}

void AxisCheck::runs_missing(std::int64_t from, std::int64_t end) {
    const std::string which = end - from == 1
                                  ? "run " + std::to_string(from) + " is"
                                  : "runs " + std::to_string(from) + " to " + std::to_string(end - 1) + " are";
    differ("axis " + name_ + ": the record of " + which + " not in the log; the steps up to " +
               at_tick(last_tick_, "its beginning") + " are compared",
           {}, {});
}

void AxisCheck::on_batch(const analysis::StepBatch& batch) {
    if (!findings_.going()) { return; }
    (void)birth_of(batch.incarnation);
    std::int64_t count = batch.position_before_steps;
    const ClockStretch time = batch.machine_time();
    for (const StepEdge& step : batch.steps) {
        count += step.direction;
        waiting_.push_back({step, count, batch.incarnation, time.at(step.tick), batch.clock_error});
    }
    settle(false);
    if (waiting_.size() > kMaxWaiting) {
        differ(
            "axis " + name_ + ": no run is recorded for " + plural(static_cast<std::int64_t>(waiting_.size()), "step"),
            {}, waiting_.front().edge.tick);
    }
}

void AxisCheck::on_break(const analysis::Break& what) {
    if (what.missing_batches == 0 || !findings_.going()) { return; }
    const StepEdge* expected = maker_ ? maker_->next() : nullptr;
    differ("axis " + name_ + ": " + plural(what.missing_batches, "message") + " with at least " +
               plural(std::abs(what.position_change), "step") + " missing between " +
               at_tick(what.from, "the log's beginning") + " and " + at_tick(what.to, "the log's end"),
           expected != nullptr ? std::optional(expected->tick) : std::nullopt, {});
}

/// Compares as far as steps and runs have come.
void AxisCheck::settle(bool log_ended) {
    while (findings_.going()) {
        if (!maker_ && !begin_next_run()) { return; }
        const SeenStep* seen = waiting_.empty() ? nullptr : &waiting_.front();
        const bool may_be_over = seen != nullptr || log_ended;
        if (maker_->next() == nullptr || (may_be_over && is_cut_here(seen))) {
            end_run();
        } else if (seen != nullptr) {
            is_of_run(*seen) ? compare(*seen) : end_process(*seen);
        } else {
            return;
        }
    }
}

bool AxisCheck::begin_next_run() {
    if (runs_.empty()) { return false; }
    maker_.emplace(std::move(runs_.front()));
    runs_.pop_front();
    const Run& run = maker_->run();
    const bool follows = last_run_ && last_run_->incarnation == run.incarnation;
    if (follows && last_run_->device_stop() != run.device_start()) {
        differ("axis " + name_ + ": " + name_of(run) + " starts at count " + std::to_string(run.device_start()) +
                   " of the device, the run before it ended at " + std::to_string(last_run_->device_stop()),
               {}, run.start);
    } else if (!run.cut && run.to().count() != run.stop_count) {
        differ("axis " + name_ + ": " + name_of(run) + " is recorded to end at " + std::to_string(run.stop_count) +
                   ", its pieces end at " + std::to_string(run.to().count()),
               {}, run.start);
    } else if (run.epoch == 0 && run.frame <= 1 && !run.tail && !starts_from_rest(run)) {
        differ("axis " + name_ + ": " + name_of(run) + " does not start from rest on a whole step", {}, run.start);
    } else if (run.epoch == 0 && (run.frame > 1 || run.tail) && follows && !goes_on(*last_run_, run)) {
        differ("axis " + name_ + ": " + name_of(run) + " does not go on from the frame before it", {}, run.start);
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

/// A run that was cut is over at its stop count, unless the steps go on as its pieces do.
bool AxisCheck::is_cut_here(const SeenStep* seen) {
    if (!maker_->run().cut || maker_->count() != maker_->run().stop_count) { return false; }
    return seen == nullptr || seen->edge != *maker_->next();
}

void AxisCheck::compare(const SeenStep& seen) {
    const StepEdge expected = *maker_->next();
    const std::int64_t count = maker_->count() + expected.direction;
    const std::string step = step_name();
    if (seen.edge.tick != expected.tick) {
        return differ(step + " is expected at tick " + std::to_string(expected.tick.value) +
                          ", the log has it at tick " + std::to_string(seen.edge.tick.value),
                      expected.tick, seen.edge.tick);
    }
    if (seen.edge.direction != expected.direction) {
        return differ(step + " is expected to go " + (expected.direction > 0 ? "forward" : "backward") +
                          ", in the log it goes the other way",
                      expected.tick, seen.edge.tick);
    }
    if (seen.count != count) {
        return differ(step + " is expected to reach " + std::to_string(count) + ", by the log it reaches " +
                          std::to_string(seen.count),
                      expected.tick, seen.edge.tick);
    }
    compare_time(seen, step);
    pass_step(true);
    waiting_.pop_front();
    ++steps_;
    if (follower_ == nullptr) { ++findings_.steps; }
    last_tick_ = expected.tick;
    if (!findings_.last_tick || *findings_.last_tick < expected.tick) { findings_.last_tick = expected.tick; }
}

/// An axis's own moves go by the device's clock alone.
void AxisCheck::compare_time(const SeenStep& seen, const std::string& step) {
    const Run& run = maker_->run();
    if (run.epoch == 0) { return; }
    const Ticks late = amount(seen.machine - maker_->commanded());
    findings_.latest = std::max(findings_.latest, late);
    findings_.clock_error = std::max(findings_.clock_error, seen.error + run.clock_error);
    if (late <= allowed(seen.error, run.clock_error)) { return; }
    differ(step + " was made at machine time " + std::to_string(seen.machine.value) + ", commanded for " +
               std::to_string(maker_->commanded().value) + "; its clocks were known within " +
               plural((seen.error + run.clock_error).value, "tick"),
           maker_->commanded(), seen.machine);
}

// ---- Processes that ended ------------------------------------------------------------------------------------------

/// Processes are told apart by their numbers, and follow each other as their first messages do.
std::size_t AxisCheck::birth_of(std::int64_t incarnation) {
    const auto known = std::ranges::find(incarnations_, incarnation);
    const auto birth = static_cast<std::size_t>(known - incarnations_.begin());
    if (known == incarnations_.end()) { incarnations_.push_back(incarnation); }
    return birth;
}

bool AxisCheck::is_of_run(const SeenStep& seen) const { return seen.incarnation == maker_->run().incarnation; }

/// The run and the step are of different processes: the older of the two left something unwritten.
void AxisCheck::end_process(const SeenStep& seen) {
    birth_of(seen.incarnation) < birth_of(maker_->run().incarnation) ? leave_steps() : leave_run();
}

/// The run is on record with its end, its last steps are not: no more than a process holds before it says them.
void AxisCheck::leave_run() {
    if (!last_run_ || last_run_->incarnation != maker_->run().incarnation) { unsaid_ = 0; }
    std::int64_t steps = 0;
    for (; maker_->next() != nullptr && !is_cut_here(nullptr); pass_step(false)) { ++steps; }
    unsaid_ += steps;
    if (unsaid_ > StepBatcher::kMaxSteps) {
        return differ("axis " + name_ + ": " + plural(unsaid_, "step") + " after " +
                          at_tick(last_tick_, "the log's beginning") +
                          " are not on record, more than its process can have held when it ended",
                      last_tick_, {});
    }
    findings_.notes.push_back("axis " + name_ + ": " + plural(steps, "step") + " after " +
                              at_tick(last_tick_, "the log's beginning") +
                              " are not on record, its process ended; by " + name_of(maker_->run()) + " it came to " +
                              std::to_string(maker_->run().stop_count));
    end_run();
}

/// Steps are on record, their run is not.
void AxisCheck::leave_steps() {
    std::vector<SeenStep> left;
    const std::int64_t of = waiting_.front().incarnation;
    for (; !waiting_.empty() && waiting_.front().incarnation == of; waiting_.pop_front()) {
        left.push_back(waiting_.front());
    }
    const Tick first = left.front().edge.tick;
    const std::string what = "axis " + name_ + ": " + plural(static_cast<std::int64_t>(left.size()), "step") +
                             " from tick " + std::to_string(first.value) + " on are of no run on record, its process " +
                             "ended; ";
    if (planned_(left.front().machine).empty()) {
        findings_.notes.push_back(what + "there is no plan to compare them with");
    } else if (are_planned(left)) {
        findings_.notes.push_back(what + "they are as planned");
    } else {
        differ(what + "they are not as planned", {}, first);
    }
}

/// Whether the steps are the first of a run that is planned for their time; counts them where they are.
bool AxisCheck::are_planned(const std::vector<SeenStep>& steps) {
    for (const Run& run : planned_(steps.front().machine)) {
        StepMaker maker(run);
        const auto is_next = [&](const SeenStep& seen) {
            if (maker.next() == nullptr || maker.next()->direction != seen.edge.direction) { return false; }
            if (amount(seen.machine - maker.commanded()) > allowed(seen.error, run.clock_error)) { return false; }
            maker.pass();
            return maker.count() == seen.count;
        };
        if (!std::ranges::all_of(steps, is_next)) { continue; }
        steps_ += static_cast<std::int64_t>(steps.size());
        findings_.steps += static_cast<std::int64_t>(steps.size());
        last_tick_ = steps.back().edge.tick;
        return true;
    }
    return false;
}

// ---- The end -------------------------------------------------------------------------------------------------------

void AxisCheck::finish() {
    if (findings_.going()) { stream_.finish(); }
    settle(true);
    if (findings_.going()) { end_of_log(); }
    if (findings_.going() && follower_ != nullptr) { follower_->on_end(); }
}

void AxisCheck::end_of_log() {
    const std::string compared = plural(steps_, "step") + " up to " + at_tick(last_tick_, "there") + " compared";
    if (maker_) {
        const Tick expected = maker_->next()->tick;
        differ("axis " + name_ + ": the log has no more steps, though " + name_of(maker_->run()) +
                   " makes one at tick " + std::to_string(expected.value) + "; " + compared,
               expected, {});
    } else if (!waiting_.empty()) {
        differ("axis " + name_ + ": " + plural(static_cast<std::int64_t>(waiting_.size()), "step") + " from tick " +
                   std::to_string(waiting_.front().edge.tick.value) + " on are of no run in the log; " + compared,
               {}, waiting_.front().edge.tick);
    }
}

void AxisCheck::differ(std::string text, std::optional<Tick> expected, std::optional<Tick> seen) {
    Difference found{.text = std::move(text), .axis = name_, .tick_expected = expected, .tick_seen = seen};
    const Run* run = maker_ ? &maker_->run() : last_run_ ? &*last_run_ : nullptr;
    if (run != nullptr) { found.commanded = commanded_(*run, expected.value_or(run->start)); }
    findings_.differ(std::move(found));
}

std::string AxisCheck::step_name() const { return "axis " + name_ + ": step " + std::to_string(steps_ + 1); }

}  // namespace lockstep::verification
