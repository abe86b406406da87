// The motion that a job's program commands for each axis, move by move: places in whole steps, and times, as the
// coordinator plans them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "clients/planning/leg_plan.hpp"
#include "core/machine.hpp"
#include "core/program_blocks.hpp"
#include "core/units.hpp"

namespace lockstep::analysis {

/// A line from one place to another, or a dwell (no steps).
struct AskedMove {
    double length_mm = 0;
    Ticks planned;   // from end to end
    Ticks stepping;  // part of `planned` from the lead axis's first step to its last
};

class AskedPath {
public:
    /// Only this many first moves have details, because a program may have millions of moves.
    static constexpr std::size_t kDetailed = 5000;

    /// The path of a job without a program (homing), which commands no moves.
    AskedPath() = default;

    /// Plans the program as the coordinator did. The error says why it cannot be planned.
    static std::expected<AskedPath, std::string> of(const MachineConfig& machine, const ProgramHead& head,
                                                    const std::shared_ptr<const ProgramBlocks>& blocks);

    std::size_t size() const { return lines_.size(); }
    /// The program's line with this move; 0: none. A program may have millions of moves.
    std::int32_t line(std::size_t move) const { return lines_[move]; }
    /// The axis with the most steps.
    std::size_t lead(std::size_t move) const { return leads_[move]; }
    /// Null if the move has no details.
    const AskedMove* details(std::size_t move) const { return move < details_.size() ? &details_[move] : nullptr; }
    Ticks planned() const { return planned_; }
    /// The number of motions from rest to rest. Between two of them the program waits for a person.
    std::int64_t legs() const { return legs_; }

    /// The number of the machine's axes; 0 without a program.
    std::size_t axes() const { return mm_per_step_.size(); }
    double mm_per_step(std::size_t axis) const { return mm_per_step_[axis]; }
    /// Machine coordinates, in steps.
    std::int64_t from(std::size_t move, std::size_t axis) const { return counts_[move * axes() + axis]; }
    std::int64_t to(std::size_t move, std::size_t axis) const { return counts_[(move + 1) * axes() + axis]; }
    std::int64_t steps(std::size_t move, std::size_t axis) const;
    /// The moves in which an axis makes steps.
    const std::vector<std::uint32_t>& moves_of(std::size_t axis) const { return moves_of_[axis]; }

private:
    void add_first(const LegPlan& leg);

    std::vector<double> mm_per_step_;   // of each axis
    std::vector<std::int64_t> counts_;  // for each place, of each axis
    std::vector<std::int32_t> lines_;   // of each move; the n-th move leads from the n-th place to the next
    std::vector<std::uint8_t> leads_;
    std::vector<AskedMove> details_;
    std::vector<std::vector<std::uint32_t>> moves_of_;
    Ticks planned_;
    std::int64_t legs_ = 0;
};

}  // namespace lockstep::analysis
