// Axes that move to their places each by itself: from where, to where, and how far they have come.
#pragma once

#include <optional>

#include "core/axis_set.hpp"
#include "core/coordinator/axes/axis_roster.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/state/refusal.hpp"
#include "core/motion/step_source.hpp"

namespace lockstep {

class OwnTargets {
public:
    OwnTargets() = default;
    /// Where a whole program ends, whatever line it takes there. `ticks`: how long each move lasts; 0: as fast as the
    /// axis can. Error: a move that its axis cannot make. Each axis's move is planned here too, so that a person is
    /// told.
    static std::expected<OwnTargets, Refusal> plan(const KnownProgram& program, Ticks ticks,
                                                   const CoordinatorLoop& loop, BeginSteps begin_steps);

    /// Those that move.
    AxisSet axes() const { return axes_; }
    const AxisCounts& from() const { return from_; }
    std::int64_t target(std::size_t axis) const { return to_[axis]; }
    void order(CoordinatorLoop& loop) const;

    /// 0 to 1, by the axis that has the most before it.
    double progress(const AxisRoster& axes) const;
    double remaining_s(Tick now, const MachineConfig& machine) const;

private:
    AxisSet axes_ = 0;
    AxisCounts from_;
    AxisCounts to_;
    Ticks ticks_;
    Tick begun_;
    double planned_s_ = 0;
};

}  // namespace lockstep
