// From a program to legs: checks every target and finds the pauses, before anything moves.
#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/leg_times.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/motion/lookahead.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Blocks that follow each other without a pause.
struct Leg {
    std::uint32_t first = 0;  // of the program's blocks, up to
    std::uint32_t end = 0;    // this one, which is the pause if there is one
    bool moves = false;       // a block moves or dwells
    bool then_pause = false;
    std::int32_t pause_line = 0;
    AxisCounts from;  // whole steps
    AxisCounts to;
    std::shared_ptr<const LegTimes> times;
};

struct PlanError {
    FaultCode fault = FaultCode::BadProgram;
    std::int32_t line = 0;
    std::string text;  // the value, the limit and the remedy
};

Ticks ticks_of(const Dwell& dwell, double tick_s);

/// The machine's side of planning: limits and scales of all axes.
class ProgramPlanner {
public:
    explicit ProgramPlanner(const MachineConfig& machine);

    /// The whole program from where the axes stand. Errors: an axis the machine lacks, a start elsewhere than the
    /// program's (StartMismatch), a target outside the travel (OutsideTravel), a move that is too long to count.
    std::expected<std::vector<Leg>, PlanError> plan(const Program& program, const AxisCounts& start) const;

    /// What the frames of a leg are made of. It is resumed before it makes any.
    std::unique_ptr<FrameSource> frames(std::shared_ptr<const Program> program, const Leg& leg) const;

    /// The moves of a leg from whole step to whole step, and its dwells.
    void each_move(const Program& program, const Leg& leg, const std::function<void(const PathMove&)>& visit) const;
    std::vector<PathMove> moves(const Program& program, const Leg& leg) const;

private:
    std::expected<std::vector<std::size_t>, PlanError> axes_of(const Program& program) const;
    std::expected<void, PlanError> check_start(const Program& program, const std::vector<std::size_t>& axes,
                                               const AxisCounts& start) const;
    std::expected<AxisCounts, PlanError> target(const LinearMove& move, const std::vector<std::size_t>& axes,
                                                const AxisCounts& from, std::int32_t line) const;
    PathMove path_move(const LinearMove& linear, const AxisCounts& from, const AxisCounts& to) const;

    MachineConfig machine_;
    std::vector<AxisLimits> limits_;
    std::vector<double> steps_per_mm_;
};

}  // namespace lockstep
