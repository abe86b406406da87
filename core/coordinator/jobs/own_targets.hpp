// Axes that move to their places, each by itself: where they start, where they go, and their progress.
#pragma once

#include "core/axis_set.hpp"
#include "core/coordinator/axes/axis_roster.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/state/refusal.hpp"
#include "core/motion/step_source.hpp"

namespace lockstep {

class OwnTargets {
public:
    OwnTargets() = default;
    /// The targets are where a whole program ends, independently of its path. `ticks`: how long each move lasts;
    /// nullopt: as fast as the axis can. Error: a move that its axis cannot make. Each axis's move is planned here,
    /// too, so that the client gets the reason.
    static std::expected<OwnTargets, Refusal> plan(const KnownProgram& program, std::optional<Ticks> ticks,
                                                   const LoopView& loop, BeginSteps begin_steps);

    /// The axes that move.
    AxisSet axes() const { return axes_; }
    const AxisCounts& from() const { return from_; }
    std::int64_t target(std::size_t axis) const { return to_[axis]; }
    void order(AxisOrders& orders, const Term& term) const;

    /// 0 to 1, by the axis with the least progress.
    double progress(const AxisRoster& axes) const;
    double remaining_s(Tick now, const MachineConfig& machine) const;

private:
    AxisSet axes_ = 0;
    AxisCounts from_;
    AxisCounts to_;
    std::optional<Ticks> ticks_;
    Tick begun_;
    double planned_s_ = 0;
};

}  // namespace lockstep
