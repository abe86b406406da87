// Passes a program's blocks to its planner, checks them and counts the moves.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/coordinator/path/program_plan.hpp"
#include "core/coordinator/program/probe_check.hpp"

namespace lockstep {

/// Blocks must be read in order. The program ends before the first invalid block.
class CountedBlocks final : public ProgramBlocks {
public:
    /// `axes`: indices of the machine's axes that the program names.
    CountedBlocks(const ProgramPlanner& planner, std::shared_ptr<const ProgramBlocks> blocks,
                  std::vector<AxisIndex> axes, const AxisCounts& start);

    const std::vector<std::string>& axes() const override { return blocks_->axes(); }
    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override;
    std::optional<std::span<const double>> place_before(std::uint32_t number) const override {
        return blocks_->place_before(number);
    }

    int moves() const { return moves_; }
    double length_mm() const { return length_mm_; }
    /// The error of the first invalid block; nullopt if there is none.
    const std::optional<PlanError>& error() const { return error_; }

private:
    bool count(const Block& block, std::uint32_t number) const;
    std::expected<void, PlanError> check_probing(const Block& block, std::uint32_t number) const;

    const ProgramPlanner& planner_;
    std::shared_ptr<const ProgramBlocks> blocks_;
    std::vector<AxisIndex> axes_;
    // Mutable because a FrameSource reads its blocks through const functions. The counts do not affect the blocks.
    mutable AxisCounts at_;
    mutable std::uint32_t next_ = 0;
    mutable int moves_ = 0;
    mutable double length_mm_ = 0;
    mutable std::optional<ProbeCheck> probe_;  // of a probing move whose end is not reached
    mutable std::optional<PlanError> error_;
};

}  // namespace lockstep
