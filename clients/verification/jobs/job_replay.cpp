#include "clients/verification/jobs/job_replay.hpp"

#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep::verification {

JobReplay::JobReplay(const MachineConfig& machine, SharedProgram program, std::vector<Leg> legs)
    : machine_(machine),
      kinematics_(machine),
      planner_(machine),
      program_(std::move(program)),
      legs_(std::move(legs)) {}

std::expected<JobReplay, std::string> JobReplay::plan(const MachineConfig& machine, SharedProgram program,
                                                      const std::vector<std::int64_t>& start_counts) {
    const std::size_t plays = has_backlash(machine) ? motor_count(machine) : 0;
    if (start_counts.size() != machine.axes.size() + plays) {
        return std::unexpected(std::string("it starts with another number of axes than the machine has"));
    }
    AxisCounts start;
    for (const AxisIndex i : axis_indices(machine.axes.size())) { (void)start.push_back(start_counts[i]); }
    auto legs = ProgramPlanner(machine).plan(program->head(), *program, start);
    if (!legs) { return std::unexpected(legs.error().text); }
    return JobReplay(machine, std::move(program), std::move(*legs));
}

/// Skips legs without anything left to run, because the coordinator records no epoch for them.
std::optional<EpochStart> JobReplay::next(const std::vector<std::int64_t>& plays) {
    for (; leg_ < legs_.size(); ++leg_, source_ = {}) {
        const Leg& leg = legs_[leg_];
        if (!leg.moves) { continue; }
        if (!source_) {
            source_ = planner_.frames(program_, leg.first, leg.from);
            place_ = {leg.first, {}};
            positions_ = positions_of(kinematics_.motors_at(leg.from).steps);
            for (std::size_t m = 0; m < plays.size() && m < positions_.size(); ++m) {
                positions_[m] = positions_[m] + Displacement::steps(plays[m]);
            }
        }
        source_->resume(place_, positions_, {});
        source_->read_ahead();
        if (!source_->is_done()) { return EpochStart{source_, place_, positions_, touch_of(leg)}; }
    }
    return std::nullopt;
}

TouchInputs JobReplay::touch_of(const Leg& leg) const {
    const Block* const before = leg.first > 0 ? program_->block(leg.first - 1) : nullptr;
    const auto* const probe = before != nullptr ? std::get_if<Probe>(&before->action) : nullptr;
    if (probe == nullptr) { return {}; }
    const auto axes = planner_.axes_of(program_->axes()).value();
    return planner_.touch_inputs(*probe, program_->block(leg.first), axes, leg.from);
}

std::uint32_t JobReplay::moves_from() const {
    if (source_) { return place_.block; }
    for (std::size_t leg = leg_; leg < legs_.size(); ++leg) {
        if (legs_[leg].moves) { return legs_[leg].first; }
    }
    return program_->size();
}

void JobReplay::ended(const EpochEnd& end, OwnedSource source) {
    if (end.kind == EpochEnd::Kind::Complete) {
        source_ = {};
        ++leg_;
        return;
    }
    source_ = std::move(source);
    place_ = end.place;
    positions_ = end.positions;
}

}  // namespace lockstep::verification
