// The blocks of a program on their way to its planner: checked, and its moves counted.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/coordinator/path/program_plan.hpp"

namespace lockstep {

/// Blocks are taken in their order. Behind the first one that is wrong there is none.
class CountedBlocks final : public ProgramBlocks {
public:
    /// `axes`: those of the machine that the program names.
    CountedBlocks(const ProgramPlanner& planner, std::shared_ptr<const ProgramBlocks> blocks,
                  std::vector<std::size_t> axes, AxisCounts start);

    const std::vector<std::string>& axes() const override { return blocks_->axes(); }
    const Block* block(std::uint32_t number) const override;
    bool ends_before(std::uint32_t number) const override;
    std::optional<std::span<const double>> place_before(std::uint32_t number) const override {
        return blocks_->place_before(number);
    }

    int moves() const { return moves_; }
    double length_mm() const { return length_mm_; }
    /// What is wrong with a target.
    const std::optional<PlanError>& error() const { return error_; }

private:
    bool count(const Block& block, std::uint32_t number) const;

    const ProgramPlanner& planner_;
    std::shared_ptr<const ProgramBlocks> blocks_;
    std::vector<std::size_t> axes_;
    // A source of frames reads what it is made of; what is noted here changes nothing for it.
    mutable AxisCounts at_;
    mutable std::uint32_t next_ = 0;
    mutable int moves_ = 0;
    mutable double length_mm_ = 0;
    mutable std::optional<PlanError> error_;
};

}  // namespace lockstep
