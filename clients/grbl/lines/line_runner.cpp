#include "clients/grbl/lines/line_runner.hpp"

#include "core/coordinator/path/coordination.hpp"

namespace lockstep::grbl {
namespace {

using std::chrono::nanoseconds;

bool is_held(MachinePhase phase) { return phase == MachinePhase::Holding || phase == MachinePhase::Paused; }

bool is_busy(MachinePhase phase) {
    return is_held(phase) || phase == MachinePhase::Running || phase == MachinePhase::Stopping ||
           phase == MachinePhase::Homing || phase == MachinePhase::Jogging;
}

/// After this time the newest state shows the effect of an answered command.
nanoseconds state_age(const MachineConfig& machine) { return std::chrono::microseconds{3 * machine.timing.slot_us}; }

}  // namespace

void LineRunner::take(std::uint64_t request, LineToRun&& line) { next_ = Next{request, std::move(line)}; }

void LineRunner::pass(const MachineState& state, bool rests, nanoseconds now) {
    accept(now);
    if (program_) { pass_program(state, now); }
    pass_hold(state);
    pass_stop(state, rests, now);
}

void LineRunner::accept(nanoseconds now) {
    if (!next_ || !queue_.has_room()) { return; }
    Next next = *std::exchange(next_, std::nullopt);
    const auto behind = next.line.is_answered_behind ? std::optional(next.request) : std::nullopt;
    const std::int32_t number = queue_.add(next.line, behind);
    for (Block& block : next.line.blocks) { block.line = number; }
    later_.push_back({std::move(next.line.from_mm), std::move(next.line.blocks), number, next.line.probes});
    appended_ = now;
    append_later();
    if (!behind) { answers_.push_back({next.request, {.is_done = true}}); }
}

void LineRunner::append_later() {
    while (!later_.empty() && (!program_ || program_->is_open())) {
        Later later = std::move(later_.front());
        later_.pop_front();
        if (!program_) { program_ = std::make_unique<LineProgram>(machine_, std::move(later.from_mm), port_); }
        for (const Block& block : later.blocks) { program_->append(block); }
        last_ = later.number;
        if (later.probes) { program_->end(); }
    }
}

void LineRunner::pass_program(const MachineState& state, nanoseconds now) {
    switch (program_->pass(state, is_hold_wanted_, now)) {
        case LineProgram::Outcome::Lost: return lose(state, now);
        case LineProgram::Outcome::Probed: return end_probing(state);
        case LineProgram::Outcome::Done:
            answer_done(queue_.pass(last_));
            close();
            return append_later();
        case LineProgram::Outcome::Goes: break;
    }
    if (program_->is_job_of(state) && state.line) { answer_done(queue_.pass_to(*state.line)); }
    if (program_->is_open() && must_end(state, now)) { program_->end(); }
}

/// Until it knows the program's end, the machine does not run the last distance, which it needs to stop. A line that
/// waits for room gets it as the machine moves, so it does not end the program.
bool LineRunner::must_end(const MachineState& state, nanoseconds now) const {
    if (now - appended_ < kIdle) { return false; }
    if (coordination_of(machine_).plans_whole) { return true; }
    if (!program_->is_job_of(state) || state.phase != MachinePhase::Running) { return false; }
    if (!program_->is_sent_since(state_age(machine_), now)) { return false; }
    return state.lacks_blocks || (!next_ && now - appended_ >= kLongIdle && state.remaining_s < kNearEnd_s);
}

void LineRunner::begin(std::optional<CommandTracker>& tracker, CommandKind kind) {
    tracker.emplace(Command{.kind = kind});
    follow(tracker);
}

void LineRunner::follow(std::optional<CommandTracker>& tracker) {
    if (tracker && is_over(port_.follow(*tracker))) { tracker.reset(); }
}

void LineRunner::hold() {
    is_hold_wanted_ = has_lines();
    if (!is_hold_wanted_) { begin(hold_, CommandKind::Hold); }
}

void LineRunner::resume() {
    is_hold_wanted_ = false;
    const bool is_machine_held = !program_ || program_->is_begun();
    if (is_machine_held) { begin(resume_, CommandKind::Resume); }
}

void LineRunner::pass_hold(const MachineState& state) {
    const bool is_job = program_ && program_->is_job_of(state);
    if (!has_lines() || (is_job && is_held(state.phase))) { is_hold_wanted_ = false; }
    const bool moves = is_job && state.phase == MachinePhase::Running;
    if (is_hold_wanted_ && moves && !hold_) { begin(hold_, CommandKind::Hold); }
    follow(hold_);
    follow(resume_);
}

void LineRunner::stop(nanoseconds now) {
    drop();
    begin(stop_, CommandKind::Stop);
    stopping_since_ = now;
}

void LineRunner::pass_stop(const MachineState& state, bool rests, nanoseconds now) {
    if (stop_) {
        follow(stop_);
        stopping_since_ = now;
    }
    if (stop_ || !stopping_since_) { return; }
    const bool has_stopped = !is_busy(state.phase) && rests && now - *stopping_since_ > state_age(machine_);
    if (has_stopped || now - *stopping_since_ > kStopPatience) { stopping_since_.reset(); }
}

void LineRunner::answer_done(const std::vector<std::uint64_t>& requests, const Answer& answer) {
    for (const std::uint64_t request : requests) { answers_.push_back({request, answer}); }
}

/// The line that probed was run, also if it did not touch. The sender decides what comes next.
void LineRunner::end_probing(const MachineState& state) {
    answer_done(queue_.pass(last_), {.is_done = true, .why = state.job_fault, .probe = state.probe});
    close();
    append_later();
}

/// Gives no reason if the machine has a fault, because the fault is an alarm by itself.
void LineRunner::lose(const MachineState& state, nanoseconds now) {
    if (state.fault == FaultCode::None) { loss_ = program_->why(); }
    program_->may_run(state) && state.fault == FaultCode::None ? stop(now) : drop();
}

void LineRunner::drop() {
    for (const std::uint64_t request : queue_.drop()) { answers_.push_back({request, {}}); }
    if (next_) { answers_.push_back({next_->request, {}}); }
    next_.reset();
    later_.clear();
    is_hold_wanted_ = false;
    hold_.reset();
    resume_.reset();
    close();
}

void LineRunner::leave() {
    next_.reset();
    later_.clear();
    if (!program_ || !program_->is_begun()) { return drop(); }
    program_->end();
}

void LineRunner::close() {
    if (program_) { port_.close(); }
    program_.reset();
}

void LineRunner::report(const MachineState& state, MachineView& view) const {
    view.lines = queue_.size() + (next_ ? 1 : 0);
    view.is_held = is_hold_wanted_;
    view.is_stopping = stopping_since_.has_value();
    if (program_ && program_->is_job_of(state) && state.line) { view.line = queue_.sender_line(*state.line); }
}

}  // namespace lockstep::grbl
