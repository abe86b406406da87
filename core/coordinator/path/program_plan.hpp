// From a program to moves: checks every target and works out every move's limits, before anything moves.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/motion/lookahead.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Moves that follow each other without a pause.
struct Leg {
    std::vector<PathMove> moves;
    bool then_pause = false;
    std::int32_t pause_line = 0;
    Subticks duration;  // planned
};

struct PlanError {
    FaultCode fault = FaultCode::BadProgram;
    std::int32_t line = 0;
    std::string text;  // the value, the limit and the remedy
};

/// The machine's side of planning: limits and scales of all axes.
class ProgramPlanner {
public:
    explicit ProgramPlanner(const MachineConfig& machine);

    /// The whole program from where the axes stand. Errors: an axis the machine lacks, a start elsewhere than the
    /// program's (StartMismatch), a target outside the travel (OutsideTravel), a move that is too long to count.
    std::expected<std::vector<Leg>, PlanError> plan(const Program& program, const AxisCounts& start) const;

    /// Profiles for a leg or what remains of it; the first move starts `along` its lead axis.
    Path path(std::vector<PathMove> moves, Displacement along, const Overrides& overrides = {}) const;

private:
    std::expected<std::vector<std::size_t>, PlanError> axes_of(const Program& program) const;
    std::expected<AxisCounts, PlanError> target(const LinearMove& move, const std::vector<std::size_t>& axes,
                                                const AxisCounts& from, std::int32_t line) const;

    MachineConfig machine_;
    std::vector<AxisLimits> limits_;
    std::vector<double> steps_per_mm_;
};

}  // namespace lockstep
