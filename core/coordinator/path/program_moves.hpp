// Passes the moves and dwells of a leg's blocks to a path, in steps.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/output_pace.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/path/path_input.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

class ProgramMoves {
public:
    explicit ProgramMoves(const MachineConfig& machine)
        : limits_(axis_frame_limits_of(machine)), tick_s_(static_cast<double>(machine.tick_ns) * 1e-9), pace_(machine) {
        for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
    }

    /// Begins a leg. `axes`: the machine's axes that the program names. `from`: where all axes stand.
    void begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const AxisIndex> axes,
               std::uint32_t first, const AxisCounts& from);

    /// A block that has been read; null if there was none. At the leg's end `ends` is set.
    struct Read {
        const Block* block = nullptr;
        bool ends = false;
    };
    /// Reads the next block, or ends the leg. Returns neither if the next block is not at hand.
    Read read(PathInput& path);

    const ProgramBlocks& program() const { return *program_; }
    /// The number of the next block.
    std::uint32_t next() const { return next_; }
    /// The next block was not at hand.
    bool is_starved() const { return is_starved_; }
    /// Where the leg ended.
    LegEnd end() const { return {end_.kind, next_, rest(), end_.pause, end_.probe}; }

private:
    bool begin_at_place(PathInput& path);
    AxisCounts rest() const;
    double measure(const ProgramMove& move);
    void pass(const ProgramMove& move, std::uint32_t number, PathInput& path);
    Read finish(PathInput& path);

    std::shared_ptr<const ProgramBlocks> program_;
    std::vector<double> steps_per_mm_;
    std::vector<AxisLimits> limits_;
    std::vector<AxisIndex> axes_;  // the machine's axes that the program names
    double tick_s_ = 0;
    OutputPace pace_;
    std::vector<double> from_mm_;  // of the move that was measured, by axis of the program
    std::vector<double> way_mm_;   // of it, by axis of the machine; a circle goes all its length along both of its axes
    std::uint32_t next_ = 0;
    bool has_moved_ = false;  // a move of the leg was read
    bool is_starved_ = false;
    LegEnd end_;  // how the leg ends
    AxisCounts from_;
    PlaceVector at_;                   // where the last block read leads to
    std::optional<PlaceVector> rest_;  // where the path ends so far; it rests on whole steps
};

}  // namespace lockstep
