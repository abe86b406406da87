#include "core/coordinator/values/value_keeper.hpp"

namespace lockstep {

std::string text_of(const ValuesRefusal& refusal) {
    if (refusal.why == ValuesRefusal::Why::JobInProgress) {
        return "a job in progress uses these values; wait until it pauses (M0, M6) or has ended, or stop it";
    }
    return "the machine's offsets or tools have changed since this command read them: revision " +
           std::to_string(refusal.read) + ", now " + std::to_string(refusal.now) + "; give the command again";
}

std::expected<void, ValuesRefusal> ValueKeeper::accept(std::uint64_t program, const gcode::ProgramValues& values,
                                                       Circumstances now) {
    if (now.owns_machine && values.revision != revision_) {
        return std::unexpected(ValuesRefusal{ValuesRefusal::Why::Changed, values.revision, revision_});
    }
    if (values.at_once) { return edit(values, now); }
    arrived_.push_back({program, values.revision, values.after});
    if (arrived_.size() > kMostArrived) { arrived_.pop_front(); }
    return {};
}

std::expected<void, ValuesRefusal> ValueKeeper::edit(const gcode::ProgramValues& values, Circumstances now) {
    if (!now.owns_machine || !values.after) { return {}; }
    if (now.has_job && !now.is_paused) { return std::unexpected(ValuesRefusal{ValuesRefusal::Why::JobInProgress}); }
    change(*values.after);
    return {};
}

void ValueKeeper::note_left(std::uint64_t program, const gcode::KeptValues& after) {
    for (Arrived& arrived : arrived_) {
        if (arrived.program == program) { arrived.after = after; }
    }
    if (running_ && running_->program == program) { running_->after = after; }
}

void ValueKeeper::take(const JobEvent& event) {
    if (event.job_kind == JobKind::Jog || event.job_kind == JobKind::Return) { return; }  // perhaps in another's pause
    if (event.kind == JobEvent::Kind::Begun) { running_.reset(); }
    if (!event.program_id) { return; }
    const std::uint64_t program = *event.program_id;
    if (event.kind == JobEvent::Kind::Begun) {
        running_ = Arrived{program, revision_, after(program)};
        began_ = values_;
    }
    if (event.kind != JobEvent::Kind::Ended) { return; }
    const auto running = std::exchange(running_, std::nullopt);
    const auto left = running && running->program == program ? running->after : after(program);
    if (event.outcome == JobOutcome::Done && left) { change(running ? gcode::merged(began_, *left, values_) : *left); }
}

void ValueKeeper::follow(std::uint64_t revision, gcode::KeptValues values) {
    if (revision == revision_ && values == values_) { return; }
    revision_ = revision;
    values_ = std::move(values);
    ++changes_;
}

std::vector<std::uint64_t> ValueKeeper::take_outdated() {
    std::vector<std::uint64_t> outdated;
    for (const Arrived& arrived : arrived_) {
        if (arrived.revision != revision_) { outdated.push_back(arrived.program); }
    }
    std::erase_if(arrived_, [this](const Arrived& arrived) { return arrived.revision != revision_; });
    return outdated;
}

void ValueKeeper::change(const gcode::KeptValues& values) {
    if (values == values_) { return; }
    values_ = values;
    ++revision_;
    ++changes_;
}

/// The program of a job that was taken over arrived before the takeover.
std::optional<gcode::KeptValues> ValueKeeper::after(std::uint64_t program) const {
    for (const Arrived& arrived : arrived_) {
        if (arrived.program == program) { return arrived.after; }
    }
    return std::nullopt;
}

}  // namespace lockstep
