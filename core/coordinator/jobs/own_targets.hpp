// Axes that move to their places, each by itself with its own motor: where they start, where they go, and their
// progress.
#pragma once

#include "core/coordinator/axes/axis_roster.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/state/refusal.hpp"
#include "core/indices.hpp"
#include "core/motion/step_source.hpp"

namespace lockstep {

class OwnTargets {
public:
    OwnTargets() = default;
    /// The targets are the positions at the end of the program; its path does not matter. `ticks`: how long each move
    /// lasts; nullopt: as fast as the axis can. Errors: a move that its axis cannot make, and one of an axis that needs
    /// several motors. Each axis's move is planned here, too, so that the client gets the reason.
    static std::expected<OwnTargets, Refusal> plan(const KnownProgram& program, std::optional<Ticks> ticks,
                                                   const LoopView& loop, BeginSteps begin_steps);

    /// The motors that make up steps that their encoders show as lost, in machines that ask for that
    /// (correct_following_error_mm). Their targets are where they rest by their counts.
    static OwnTargets of_lost_steps(const LoopView& loop);

    /// The motors that move.
    MotorSet motors() const { return motors_; }
    /// Where the axes were.
    const AxisCounts& from() const { return from_; }
    std::int64_t target(MotorIndex motor) const { return ends_[motor]; }
    void order(AxisOrders& orders, const Term& term) const;

    /// 0 to 1, by the axis with the least progress.
    double progress(const AxisRoster& axes) const;
    double remaining_s(Tick now, const MachineConfig& machine) const;

private:
    AxisCommandKind order_ = AxisCommandKind::MoveOwn;
    MotorSet motors_;
    AxisCounts from_;
    MotorCounts begins_;
    MotorCounts ends_;
    std::optional<Ticks> ticks_;
    Tick begun_;
    double planned_s_ = 0;
};

}  // namespace lockstep
