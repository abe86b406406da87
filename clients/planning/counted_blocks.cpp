#include "clients/planning/counted_blocks.hpp"

#include <utility>

namespace lockstep {

CountedBlocks::CountedBlocks(const ProgramPlanner& planner, std::shared_ptr<const ProgramBlocks> blocks,
                             std::vector<AxisIndex> axes, const AxisCounts& start)
    : planner_(planner), blocks_(std::move(blocks)), axes_(std::move(axes)), at_(start) {}

const Block* CountedBlocks::block(std::uint32_t number) const {
    const Block* const block = blocks_->block(number);
    if (block != nullptr && number == next_ && !count(*block, number)) { return nullptr; }
    return block;
}

/// An invalid block ends the program, so the next block is checked here before it is read.
bool CountedBlocks::ends_before(std::uint32_t number) const {
    if (blocks_->ends_before(number)) { return true; }
    if (number == next_) { (void)block(number); }
    return error_ && number >= next_;
}

bool CountedBlocks::count(const Block& block, std::uint32_t number) const {
    if (error_) { return false; }
    if (const auto probed = check_probing(block, number); !probed) {
        error_ = probed.error();
        return false;
    }
    const auto length_mm = planner_.length_of(block, number, axes_, at_);
    if (!length_mm) {
        error_ = length_mm.error();
        return false;
    }
    ++next_;
    if (*length_mm) {
        ++moves_;
        length_mm_ += **length_mm;
    }
    return true;
}

/// A coordinator gets each probing move as the end of a program, and refuses it by the same rule.
std::expected<void, PlanError> CountedBlocks::check_probing(const Block& block, std::uint32_t number) const {
    if (std::holds_alternative<Probe>(block.action)) { probe_.emplace(); }
    if (!probe_) { return {}; }
    const auto from_mm = blocks_->place_before(number);
    const auto fits =
        from_mm ? probe_->next(block, planner_.machine(), axes_, *from_mm) : std::expected<void, PlanError>{};
    if (std::holds_alternative<ProgramMove>(block.action)) { probe_.reset(); }
    return fits;
}

}  // namespace lockstep
