#include "clients/grbl/lines/line_runner.hpp"

#include "core/coordinator/path/coordination.hpp"

namespace lockstep::grbl {
namespace {

using std::chrono::nanoseconds;

bool is_busy(MachinePhase phase) {
    return phase == MachinePhase::Holding || phase == MachinePhase::Paused || phase == MachinePhase::Running ||
           phase == MachinePhase::Stopping || phase == MachinePhase::Homing || phase == MachinePhase::Jogging;
}

void add_answers(std::vector<LineRunner::Answered>& answers, const std::vector<std::uint64_t>& requests,
                 const Answer& answer) {
    for (const std::uint64_t request : requests) { answers.push_back({request, answer}); }
}

/// After this time the newest state shows the effect of an answered command.
nanoseconds state_age(const MachineSetup& machine) { return std::chrono::microseconds{3 * machine.timing.slot_us}; }

}  // namespace

void LineRunner::take(std::uint64_t request, LineToRun&& line) { next_ = Next{request, std::move(line)}; }

void LineRunner::pass(const MachineState& state, bool rests, nanoseconds now) {
    accept(now);
    if (program_) { pass_program(state, now); }
    const bool is_job = program_ && program_->is_job_of(state);
    hold_.pass(has_lines(), is_job ? std::optional(state.phase) : std::nullopt);
    stop_.pass(!is_busy(state.phase) && rests, state_age(machine_), now);
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
    switch (program_->pass(state, hold_.is_wanted(), now)) {
        case LineProgram::Outcome::Lost: return lose(state, now);
        // The line that probed was run, also if it did not touch. The sender decides what comes next.
        case LineProgram::Outcome::Probed:
            return end_program({.is_done = true, .why = state.job_fault, .probe = state.probe});
        case LineProgram::Outcome::Done: return end_program({.is_done = true});
        case LineProgram::Outcome::Goes: break;
    }
    if (program_->is_job_of(state) && state.line) {
        add_answers(answers_, queue_.pass_to(*state.line), {.is_done = true});
    }
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

void LineRunner::hold() { hold_.hold(has_lines()); }

void LineRunner::resume() { hold_.resume(!program_ || program_->is_begun()); }

void LineRunner::stop(nanoseconds now) {
    drop();
    stop_.begin(now);
}

void LineRunner::end_program(const Answer& answer) {
    add_answers(answers_, queue_.pass(last_), answer);
    close();
    append_later();
}

/// Gives no reason if the machine has a fault, because the fault is an alarm by itself.
void LineRunner::lose(const MachineState& state, nanoseconds now) {
    if (state.fault == FaultCode::None) { loss_ = program_->why(); }
    program_->may_run(state) && state.fault == FaultCode::None ? stop(now) : drop();
}

void LineRunner::drop() {
    add_answers(answers_, queue_.drop(), {});
    if (next_) { answers_.push_back({next_->request, {}}); }
    next_.reset();
    later_.clear();
    hold_.drop();
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
    view.is_held = hold_.is_wanted();
    view.is_stopping = stop_.is_in_progress();
    if (program_ && program_->is_job_of(state) && state.line) { view.line = queue_.sender_line(*state.line); }
}

}  // namespace lockstep::grbl
