#include "tests/benchmarks/planners/lockstep_motion.hpp"

#include <cmath>

#include "clients/planning/plan_summary.hpp"

namespace lockstep::planners {
namespace {

/// Follows one axis's pieces.
class AxisReader {
public:
    AxisReader(const AxisMotion& motion, double mm_per_step) : pieces_(motion.pieces()), mm_per_step_(mm_per_step) {}

    /// The place at time t. Times must ascend and be within the leg.
    double mm_at(Ticks t) {
        while (piece_ + 1 < pieces_.size() && pieces_[piece_ + 1].begin <= t) { ++piece_; }
        const AxisMotion::TimedPiece& piece = pieces_[piece_];
        const Position at = piece.from + piece.piece.covered(std::min(t - piece.begin, piece.piece.ticks));
        return at.as_steps() * mm_per_step_;
    }

private:
    const std::deque<AxisMotion::TimedPiece>& pieces_;
    double mm_per_step_;
    std::size_t piece_ = 0;
};

ChangeShares changes_of(const LegPlan& leg, const MachineConfig& machine) {
    std::vector<AxisReader> axes;
    for (std::size_t i = 0; i < kAxes; ++i) { axes.emplace_back(leg.axes[i], 1 / machine.axes[i].steps_per_mm); }
    const auto place_at = [&axes](Ticks t) { return Vector{axes[0].mm_at(t), axes[1].mm_at(t), axes[2].mm_at(t)}; };
    const Ticks every{std::llround(kSample_s * machine.ticks_per_second())};
    SpeedChanges changes(limits_of(machine), place_at(Ticks{}));
    for (Ticks t = every; t < leg.duration + every; t += every) { changes.take(place_at(std::min(t, leg.duration))); }
    changes.finish();
    return changes.shares();
}

}  // namespace

std::expected<LockstepMotion, PlanError> lockstep_motion(const MachineConfig& machine, const Program& program) {
    const auto legs = plan_legs(machine, program, start_counts(machine, program.head()));
    if (!legs) { return std::unexpected(legs.error()); }
    LockstepMotion motion;
    for (const LegPlan& leg : *legs) {
        motion.seconds += static_cast<double>(leg.duration.value) / machine.ticks_per_second();
        const ChangeShares changes = changes_of(leg, machine);
        for (std::size_t w = 0; w < changes.size(); ++w) {
            motion.changes[w] = std::max(motion.changes[w], changes[w]);
        }
    }
    return motion;
}

}  // namespace lockstep::planners
