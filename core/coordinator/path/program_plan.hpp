// Divides a program into legs. Checks every target and finds the pauses before anything moves.
#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/coordinator/path/frame_source.hpp"
#include "core/faults.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "core/motion/moves.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// Successive blocks without a rest between them.
struct Leg {
    std::uint32_t first = 0;  // the first block of the leg
    std::uint32_t end = 0;    // the first block after it: the pause or rest, if there is one
    bool moves = false;       // a block moves or dwells
    AxisCounts from;          // whole steps
    AxisCounts to;
};

struct PlanError {
    FaultCode fault = FaultCode::BadProgram;
    std::optional<std::int32_t> line;
    std::string text;  // the value, the limit and the remedy
};

Ticks ticks_of(const Dwell& dwell, double tick_s);

/// Program: the block does not end a leg. Before other blocks the machine comes to rest, on whole steps.
inline LegEnd::Kind end_by(const Block& block) {
    if (std::holds_alternative<Pause>(block.action)) { return LegEnd::Kind::Pause; }
    if (std::holds_alternative<Probe>(block.action)) { return LegEnd::Kind::Probe; }
    return std::holds_alternative<Settle>(block.action) ? LegEnd::Kind::Settle : LegEnd::Kind::Program;
}
/// Sets how the leg ends, if it ends before `block`.
inline void note_end(const Block& block, LegEnd& end) {
    end.kind = end_by(block);
    if (const auto* pause = std::get_if<Pause>(&block.action)) { end.pause = *pause; }
    if (const auto* probe = std::get_if<Probe>(&block.action)) { end.probe = *probe; }
}
inline bool ends_leg(const Block& block) { return end_by(block) != LegEnd::Kind::Program; }

/// The machine's side of planning: limits and scales of all axes.
class ProgramPlanner {
public:
    explicit ProgramPlanner(const MachineConfig& machine);

    const MachineConfig& machine() const { return machine_; }

    /// Plans the whole program from where the axes stand. Errors: an axis that the machine lacks, a start that differs
    /// from the program's (StartMismatch), a start or a target outside the travel (OutsideTravel), a move that is too
    /// long to count.
    std::expected<std::vector<Leg>, PlanError> plan(const ProgramHead& head, const ProgramBlocks& blocks,
                                                    const AxisCounts& start) const;
    /// The machine's input of this use that programs know by this number; null if it has none.
    const InputConfig* input(InputUse use, int number) const { return input_numbered(machine_.inputs, use, number); }
    /// The inputs at whose touch a probing move ends, in the order of the file; none if the machine has none of this
    /// number. `move`: it begins at `from`, in a program with these `axes` (axes_of); null: it is not known yet.
    TouchInputs touch_inputs(const Probe& probe, const Block* move, std::span<const AxisIndex> axes,
                             const AxisCounts& from) const;
    std::expected<std::vector<Leg>, PlanError> plan(const Program& program, const AxisCounts& start) const {
        return plan(program.head(), WholeProgram(borrowed(program)), start);
    }

    /// Returns the source of a leg's frames: of the blocks from `first` on, where the axes stand at `from`. The caller
    /// resumes it before it makes a frame. For the LAI method the whole program must be known.
    std::unique_ptr<FrameSource> frames(std::shared_ptr<const ProgramBlocks> program, std::uint32_t first,
                                        const AxisCounts& from) const;
    std::unique_ptr<FrameSource> frames(std::shared_ptr<const Program> program, const Leg& leg) const {
        return frames(std::make_shared<WholeProgram>(std::move(program)), leg.first, leg.from);
    }

    /// The moves of a leg from whole step to whole step, and its dwells.
    std::vector<PathMove> moves_of(const Program& program, const Leg& leg) const;

    /// The places of axes in the machine. Error: an axis that it lacks.
    std::expected<std::vector<AxisIndex>, PlanError> axes_of(const std::vector<std::string>& names) const;
    /// Error: an axis of the machine stands outside its travel, so no frame may begin there, or the axes do not stand
    /// where the program starts.
    std::expected<void, PlanError> check_start(const ProgramHead& program, const AxisCounts& start) const;
    /// The same for a program with these `axes` (axes_of).
    std::expected<void, PlanError> check_start(const ProgramHead& program, std::span<const AxisIndex> axes,
                                               const AxisCounts& start) const;
    /// The start of a program with these `axes` (axes_of), if the axes stand `at` a place that check_start() accepts.
    /// The two can differ where motors rest on whole steps of their own.
    AxisCounts start_of(const ProgramHead& program, std::span<const AxisIndex> axes, const AxisCounts& at) const;
    /// The end of a move. If it is outside the travel only because motors rest on whole steps, it is the end of the
    /// travel. Error: it is outside the travel, or too far to count.
    std::expected<AxisCounts, PlanError> target(const ProgramMove& move, std::span<const AxisIndex> axes,
                                                const AxisCounts& from, std::optional<std::int32_t> line) const;
    /// Error: the arc has no radius, does not close, leaves the travel, or is for LAI, which has no arcs.
    std::expected<void, PlanError> check_arc(const ProgramMove& move, const std::vector<AxisIndex>& axes,
                                             std::span<const double> from_mm, std::optional<std::int32_t> line) const;
    /// Whether a block of a program with these `axes` (axes_of) moves an axis or dwells. Sets `at` to the block's end.
    bool moves(const Block& block, std::span<const AxisIndex> axes, AxisCounts& at) const;
    /// Returns the block's move or dwell from `at`, of a program with these `axes` (axes_of), and sets `at` to its end.
    /// Returns nullopt if the block neither moves nor dwells. Errors: those of target(), and moves that the LAI method
    /// cannot make.
    std::expected<std::optional<PathMove>, PlanError> move_of(const Block& block, std::uint32_t number,
                                                              const std::vector<AxisIndex>& axes, AxisCounts& at) const;
    /// Returns the length of the block's move from `at`, in mm, and sets `at` to its end. Returns nullopt if no axis
    /// moves. Errors as with move_of().
    std::expected<std::optional<double>, PlanError> length_of(const Block& block, std::uint32_t number,
                                                              const std::vector<AxisIndex>& axes, AxisCounts& at) const;

private:
    bool is_within_travel(AxisIndex axis, std::int64_t steps) const;
    void note_arc(const ProgramMove& arc, const std::vector<AxisIndex>& axes, PathMove& move) const;
    PathMove path_move(const ProgramMove& linear, const AxisCounts& from, const AxisCounts& to) const;

    MachineConfig machine_;
    Kinematics kinematics_;
    std::vector<AxisLimits> limits_;  // of the axes; their travel
    std::vector<double> steps_per_mm_;
};

}  // namespace lockstep
