#include "core/coordinator/path/program_frames.hpp"

namespace lockstep {

ProgramFrames::ProgramFrames(const MachineConfig& machine, const std::shared_ptr<const ProgramBlocks>& program,
                             std::uint32_t first, const AxisCounts& from)
    : moves_(machine), room_(machine), planner_(path_setup_of(machine)) {
    (void)begin(program, ProgramPlanner(machine).axes_of(program->axes()).value(), first, from);
}

bool ProgramFrames::begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const AxisIndex> axes,
                          std::uint32_t first, const AxisCounts& from) {
    moves_.begin(program, axes, first, from);
    resumed_ = first;
    is_finished_ = false;
    lines_.clear();
    begins_.clear();
    events_.clear();
    due_.clear();
    planner_.begin(positions_of(from));
    return true;
}

void ProgramFrames::resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) {
    resumed_ = place.block;
    events_.resume(place.block);
    planner_.resume(place, at);
    if (overrides != planner_.overrides()) { (void)planner_.set_overrides(overrides); }
}

bool ProgramFrames::read() {
    const bool is_behind = moves_.next() < resumed_ || (planner_.has_more() && planner_.is_seeking());
    const std::size_t at_once = is_behind ? kBlocksPassed : kBlocksAtOnce;
    std::size_t n = 0;
    for (; n < at_once && !is_finished_; ++n) {
        if (planner_.waiting() >= kReserve && planner_.is_ready()) { break; }
        if (!read_block()) { return n > 0; }
    }
    return n > 0 || is_finished_;
}

/// Reads a block, or a quarter turn of the arc that is being read. Returns false if the next block is not at hand.
bool ProgramFrames::read_block() {
    if (planner_.has_more()) {
        planner_.cut_on();
        return true;
    }
    const auto [block, ends] = moves_.read(planner_);
    is_finished_ = is_finished_ || ends;
    if (block == nullptr) { return ends; }
    lines_.push_back(block->line);
    if (moves_.next() <= resumed_) { lines_.clear(); }
    if (const auto* event = std::get_if<ProgramEvent>(&block->action)) {
        events_.add({moves_.next() - 1, block->line, *event});
    }
    return true;
}

std::expected<const PathFrame*, PathStuck> ProgramFrames::next() {
    const auto frame = planner_.next(room_.none() ? nullptr : this);
    if (frame && *frame != nullptr) {
        events_.take_due(**frame, planner_.begins(), due_);
        events_.list_in_tail(planner_.tail_begins(), due_in_tail_);
        forget_lines(**frame);
    }
    return frame;
}

/// Events faster than the devices' rings slow the path down.
bool ProgramFrames::has_room(std::span<const MoveBegin> body, std::span<const MoveBegin> tail, bool is_last) {
    return room_.fits(events_, body, tail, is_last);
}

void ProgramFrames::forget_lines(const PathFrame& frame) {
    begins_.push_back(frame.places[0].block);
    if (begins_.size() <= PathPlanner::kFramesKept) { return; }
    begins_.pop_front();
    events_.forget_before(begins_.front());
    while (moves_.next() - lines_.size() < begins_.front()) { lines_.pop_front(); }
}

std::optional<std::int32_t> ProgramFrames::line_of(std::uint32_t block) const {
    const std::size_t first = moves_.next() - lines_.size();
    if (block < moves_.next() && block >= first) { return lines_[block - first]; }
    const Block* const there = moves_.program().block(block);  // the leg's first block, before it was read
    return there == nullptr ? std::nullopt : there->line;
}

bool ProgramFrames::set_overrides(const Overrides& overrides) {
    OverrideResult result = planner_.set_overrides(overrides);
    while (result == OverrideResult::LacksPath && !is_finished_) {
        for (std::size_t n = 0; n < kBlocksAtOnce && !is_finished_; ++n) {
            if (!read_block()) { return false; }
        }
        result = planner_.set_overrides(overrides);
    }
    return result == OverrideResult::Taken;
}

}  // namespace lockstep
