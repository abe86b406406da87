// A program as a coordinator knows it: whole, or still growing while it runs. A RowStore keeps its blocks.
#pragma once

#include <deque>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/program/block_row.hpp"
#include "core/coordinator/program/block_times.hpp"
#include "core/coordinator/program/probe_check.hpp"
#include "core/coordinator/program/row_store.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// Why a program ends early. No more of it comes.
struct ProgramCut {
    FaultCode why = FaultCode::BadProgram;
    std::optional<std::int32_t> line;  // the line of the error
    std::string text;                  // the value, the limit and the remedy
};

class KnownProgram final : public ProgramBlocks {
public:
    /// Error: an axis that the machine lacks.
    static std::expected<KnownProgram, ProgramCut> begin(const MachineConfig& machine, ProgramHead head,
                                                         std::unique_ptr<RowStore> rows);
    /// How many numbers keep one block.
    static std::size_t row_width(const ProgramHead& head) { return lockstep::row_width(head.axes.size()); }

    /// Adds blocks to an open program. Error: the machine cannot run one of them, or they cannot be kept. None of them
    /// is then taken, and the program is cut before them.
    std::expected<void, ProgramCut> append(std::span<const Block> blocks);
    /// All of its blocks are known.
    void end() { is_open_ = false; }
    /// No more blocks come.
    void cut(ProgramCut cut);
    /// Takes its sender's estimate of how much of it is known: above 0, or nullopt if the sender does not know.
    void note_share(std::optional<double> known) { known_share_ = known; }
    /// Blocks before this one were run. They are kept as long as there is room.
    void release_before(std::uint32_t block) const { rows_->release_before(block); }

    const ProgramHead& head() const { return head_; }
    const std::vector<std::string>& axes() const override { return head_.axes; }
    /// The places of these axes in the machine.
    const std::vector<AxisIndex>& places() const { return axes_; }
    /// More blocks may come.
    bool is_open() const { return is_open_; }
    const std::optional<ProgramCut>& cut() const { return cut_; }
    std::uint32_t known() const { return known_; }
    /// How many more blocks it can take now.
    std::uint64_t free() const { return rows_->free_rows(); }
    /// The line of the last known block.
    std::optional<std::int32_t> last_line() const { return last_line_; }

    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override { return !is_open_ && number >= known_; }
    double seconds_from(const PathPlace& place) const override;
    std::optional<std::span<const double>> place_before(std::uint32_t number) const override;
    /// Returns all blocks known so far, or nullopt if not all of them are at hand.
    std::optional<Program> whole() const;
    /// Returns the first block of the leg with this block, or nullopt if it is forgotten.
    std::optional<std::uint32_t> leg_of(std::uint32_t number) const;
    /// The first block that is still kept.
    std::uint32_t first_kept() const { return rows_->first_row(); }

    static constexpr std::size_t kLegsKept = 65'536;

private:
    KnownProgram(const MachineConfig& machine, ProgramHead head, std::vector<AxisIndex> axes,
                 std::unique_ptr<RowStore> rows);
    std::expected<void, ProgramCut> check(const Block& block, std::span<const double> from_mm) const;
    std::expected<void, ProgramCut> take_all(std::span<const Block> blocks);
    void take(const Block& block);
    bool read(std::uint32_t number) const;

    ProgramPlanner planner_;
    AxisCounts zero_;  // a zero for each axis of the machine
    ProgramHead head_;
    std::vector<AxisIndex> axes_;  // places in the machine of the axes that the program names
    std::unique_ptr<RowStore> rows_;
    BlockTimes times_;
    bool is_open_ = true;
    std::optional<ProgramCut> cut_;
    std::uint32_t known_ = 0;
    std::optional<std::int32_t> last_line_;
    std::uint32_t events_together_ = 0;  // events since the last block that was no event
    ProbeCheck probes_;
    std::optional<double> known_share_;
    PauseTexts texts_;
    std::vector<double> at_mm_;        // places after the last known block
    std::deque<std::uint32_t> legs_;   // the first blocks of the newest legs
    std::vector<double> taken_;        // rows of the blocks being taken
    mutable std::vector<double> row_;  // the row that was read last
    mutable RowReader reader_;
};

}  // namespace lockstep
