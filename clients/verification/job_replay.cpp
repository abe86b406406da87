#include "clients/verification/job_replay.hpp"

#include "core/motion/interpolate.hpp"

namespace lockstep::verification {

JobReplay::JobReplay(const MachineConfig& machine, std::vector<Leg> legs)
    : machine_(machine), planner_(machine), legs_(std::move(legs)) {
    skip_empty_legs();
}

std::expected<JobReplay, std::string> JobReplay::plan(const MachineConfig& machine, const Program& program,
                                                      const std::vector<std::int64_t>& start_counts) {
    if (start_counts.size() != machine.axes.size()) {
        return std::unexpected(std::string("it starts with another number of axes than the machine has"));
    }
    AxisCounts start;
    for (const std::int64_t count : start_counts) { (void)start.push_back(count); }
    auto legs = ProgramPlanner(machine).plan(program, start);
    if (!legs) { return std::unexpected(legs.error().text); }
    return JobReplay(machine, std::move(*legs));
}

void JobReplay::skip_empty_legs() {
    while (leg_ < legs_.size() && legs_[leg_].moves.empty()) { ++leg_; }
}

std::optional<EpochStart> JobReplay::next(const Overrides& overrides) const {
    if (!remaining_.empty()) {
        return EpochStart{planner_.path(remaining_, along_, overrides), positions_, {remaining_.front().block, along_}};
    }
    if (leg_ == legs_.size()) { return std::nullopt; }
    EpochStart start{planner_.path(legs_[leg_].moves, {}, overrides), {}, {legs_[leg_].moves.front().block, {}}};
    for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
        start.at.push_back(start_of(start.path, i, start.path.moves.front().from[i]));
    }
    return start;
}

void JobReplay::ended(const Path& path, const EpochEnd& end) {
    remaining_.clear();
    if (end.kind == EpochEnd::Kind::Interrupted) {
        const PathMove& move = path.moves[end.move];
        const bool move_done = move.lead != 0 && end.along >= Displacement::steps(move.lead);
        const auto first = static_cast<std::ptrdiff_t>(end.move + (move_done ? 1 : 0));
        remaining_.assign(path.moves.begin() + first, path.moves.end());
        along_ = move_done ? Displacement{} : end.along;
        positions_ = end.positions;
    }
    if (remaining_.empty()) {
        ++leg_;
        skip_empty_legs();
    }
}

}  // namespace lockstep::verification
