#include "core/coordinator/values/value_keeper.hpp"

namespace lockstep {

std::expected<void, std::string> ValueKeeper::accept(std::uint64_t program, const gcode::ProgramValues& values,
                                                     Circumstances now) {
    if (now.owns_machine && values.revision != revision_) {
        return std::unexpected("the machine's offsets or tools have changed since this was read: revision " +
                               std::to_string(values.revision) + ", now " + std::to_string(revision_) +
                               "; give the command again");
    }
    if (values.at_once) { return edit(values, now); }
    arrived_.push_back({program, values.after});
    if (arrived_.size() > kMostArrived) { arrived_.pop_front(); }
    return {};
}

std::expected<void, std::string> ValueKeeper::edit(const gcode::ProgramValues& values, Circumstances now) {
    if (!now.owns_machine || !values.after) { return {}; }
    if (!now.is_idle) {
        return std::unexpected(
            "a job is in progress, and depends on these values; wait for its end, or: lockstep stop");
    }
    change(*values.after);
    return {};
}

void ValueKeeper::take(const JobEvent& event) {
    if (event.kind == JobEvent::Kind::Begun) { running_ = Arrived{event.program_id, after(event.program_id)}; }
    if (event.kind != JobEvent::Kind::Ended) { return; }
    const bool is_known = running_ && running_->program == event.program_id;
    const auto left = is_known ? std::exchange(running_, {})->after : after(event.program_id);
    running_.reset();
    if (event.outcome == JobOutcome::Done && left) { change(*left); }
}

void ValueKeeper::follow(std::uint64_t revision, gcode::KeptValues values) {
    revision_ = revision;
    values_ = std::move(values);
}

void ValueKeeper::change(const gcode::KeptValues& values) {
    if (values == values_) { return; }
    values_ = values;
    ++revision_;
    for (const Arrived& arrived : std::exchange(arrived_, {})) { outdated_.push_back(arrived.program); }
}

/// A job that was taken over had arrived before.
std::optional<gcode::KeptValues> ValueKeeper::after(std::uint64_t program) const {
    for (const Arrived& arrived : arrived_) {
        if (arrived.program == program) { return arrived.after; }
    }
    return std::nullopt;
}

}  // namespace lockstep
