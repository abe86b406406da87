// From a program to legs: checks every target and finds the pauses, before anything moves.
#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/coordinator/path/frame_source.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/motion/moves.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// Blocks that follow each other without a rest between two of them.
struct Leg {
    std::uint32_t first = 0;  // of the program's blocks, up to
    std::uint32_t end = 0;    // this one, which is the pause or the rest if there is one
    bool moves = false;       // a block moves or dwells
    AxisCounts from;          // whole steps
    AxisCounts to;
};

struct PlanError {
    FaultCode fault = FaultCode::BadProgram;
    std::int32_t line = 0;
    std::string text;  // the value, the limit and the remedy
};

Ticks ticks_of(const Dwell& dwell, double tick_s);

/// Program: the block ends no leg. Before the others the machine comes to rest, on whole steps.
inline LegEnd::Kind end_by(const Block& block) {
    if (std::holds_alternative<Pause>(block.action)) { return LegEnd::Kind::Pause; }
    return std::holds_alternative<Settle>(block.action) ? LegEnd::Kind::Settle : LegEnd::Kind::Program;
}
inline bool ends_leg(const Block& block) { return end_by(block) != LegEnd::Kind::Program; }

/// The machine's side of planning: limits and scales of all axes.
class ProgramPlanner {
public:
    explicit ProgramPlanner(const MachineConfig& machine);

    /// The whole program from where the axes stand. Errors: an axis the machine lacks, a start elsewhere than the
    /// program's (StartMismatch), a start or a target outside the travel (OutsideTravel), a move that is too long to
    /// count.
    std::expected<std::vector<Leg>, PlanError> plan(const ProgramHead& head, const ProgramBlocks& blocks,
                                                    const AxisCounts& start) const;
    std::expected<std::vector<Leg>, PlanError> plan(const Program& program, const AxisCounts& start) const {
        return plan(program.head(), WholeProgram(borrowed(program)), start);
    }

    /// What the frames of a leg are made of: of the blocks from `first` on, where the axes stand at `from`. It is
    /// resumed before it makes any. By the LAI method the whole program is known.
    std::unique_ptr<FrameSource> frames(std::shared_ptr<const ProgramBlocks> program, std::uint32_t first,
                                        const AxisCounts& from) const;
    std::unique_ptr<FrameSource> frames(std::shared_ptr<const Program> program, const Leg& leg) const {
        return frames(std::make_shared<WholeProgram>(std::move(program)), leg.first, leg.from);
    }

    /// The moves of a leg from whole step to whole step, and its dwells.
    std::vector<PathMove> moves_of(const Program& program, const Leg& leg) const;

    /// The places of axes in the machine. Error: one that it lacks.
    std::expected<std::vector<std::size_t>, PlanError> axes_of(const std::vector<std::string>& names) const;
    /// Error: an axis of the machine stands outside its travel, so no frame may begin there; or the axes stand
    /// elsewhere than where the program starts.
    std::expected<void, PlanError> check_start(const ProgramHead& program, const AxisCounts& start) const;
    /// Of a program with these `axes` (axes_of).
    std::expected<void, PlanError> check_start(const ProgramHead& program, std::span<const std::size_t> axes,
                                               const AxisCounts& start) const;
    /// Where a move leads. Error: outside the travel, or too far to count.
    std::expected<AxisCounts, PlanError> target(const ProgramMove& move, std::span<const std::size_t> axes,
                                                const AxisCounts& from, std::int32_t line) const;
    /// Error: an arc that has no radius or does not close, leaves the travel, or LAI is to run.
    std::expected<void, PlanError> check_arc(const ProgramMove& move, const std::vector<std::size_t>& axes,
                                             std::span<const double> from_mm, std::int32_t line) const;
    /// Whether a block of a program with these `axes` (axes_of) moves an axis or dwells. `at` becomes where it leads.
    bool moves(const Block& block, std::span<const std::size_t> axes, AxisCounts& at) const;
    /// The block's move or dwell, of a program with these `axes` (axes_of), from `at`, which becomes where it leads.
    /// Nothing: it neither moves nor dwells. Errors: as target(), and what cannot be made by the LAI method.
    std::expected<std::optional<PathMove>, PlanError> move_of(const Block& block, std::uint32_t number,
                                                              const std::vector<std::size_t>& axes,
                                                              AxisCounts& at) const;

private:
    bool is_within_travel(std::size_t axis, double mm) const;
    void note_arc(const ProgramMove& arc, const std::vector<std::size_t>& axes, PathMove& move) const;
    PathMove path_move(const ProgramMove& linear, const AxisCounts& from, const AxisCounts& to) const;

    MachineConfig machine_;
    std::vector<AxisLimits> limits_;
    std::vector<double> steps_per_mm_;
};

}  // namespace lockstep
