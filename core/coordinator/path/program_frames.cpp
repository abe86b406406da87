#include "core/coordinator/path/program_frames.hpp"

#include <cmath>

namespace lockstep {

ProgramFrames::ProgramFrames(const MachineConfig& machine, const std::shared_ptr<const ProgramBlocks>& program,
                             std::uint32_t first, const AxisCounts& from)
    : tick_s_(static_cast<double>(machine.tick_ns) * 1e-9), planner_(path_setup_of(machine)) {
    for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
    (void)begin(program, ProgramPlanner(machine).axes_of(program->axes()).value(), first, from);
}

bool ProgramFrames::begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const std::size_t> axes,
                          std::uint32_t first, const AxisCounts& from) {
    program_ = program;
    axes_.assign(axes.begin(), axes.end());
    next_ = resumed_ = first;
    has_moved_ = is_finished_ = is_starved_ = false;
    end_ = LegEnd::Kind::Program;
    to_ = from;
    lines_.clear();
    begins_.clear();
    events_.clear();
    due_.clear();
    at_.clear();
    for (const std::int64_t count : from) { at_.append(static_cast<double>(count)); }
    planner_.begin(positions_of(from));
    return true;
}

void ProgramFrames::resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) {
    resumed_ = place.block;
    events_.resume(place.block);
    planner_.resume(place, at);
    if (overrides != planner_.overrides()) { (void)planner_.turn(overrides); }
}

bool ProgramFrames::read() {
    const std::uint32_t begin = next_;
    const std::size_t at_once = next_ < resumed_ ? kBlocksPassed : kBlocksAtOnce;
    for (std::size_t n = 0; n < at_once && !is_finished_; ++n) {
        if (planner_.waiting() >= kReserve && planner_.is_ready()) { break; }
        if (!read_block()) { return next_ != begin; }
    }
    return next_ != begin || is_finished_;
}

/// Returns false if the next block is not at hand.
bool ProgramFrames::read_block() {
    if (program_->ends_before(next_)) {
        finish(LegEnd::Kind::Program);
        return true;
    }
    const Block* const block = program_->block(next_);
    is_starved_ = block == nullptr;
    if (block == nullptr) { return false; }
    if (ends_leg(*block)) {
        finish(end_by(*block));
        return true;
    }
    const auto* move = std::get_if<ProgramMove>(&block->action);
    if (move != nullptr && move->arc && !has_moved_ && !begin_at_place()) { return false; }
    const std::uint32_t number = next_++;
    lines_.push_back(block->line);
    if (next_ <= resumed_) { lines_.clear(); }
    if (const auto* dwell = std::get_if<Dwell>(&block->action)) {
        const Ticks ticks = ticks_of(*dwell, tick_s_);
        if (ticks > Ticks{}) { planner_.rest(ticks, number); }
    } else if (move != nullptr) {
        has_moved_ = true;
        read_move(*move, number);
    } else if (const auto* event = std::get_if<ProgramEvent>(&block->action)) {
        events_.add({number, block->line, *event});
    }
    return true;
}

/// Begins at the program's exact place. The axes begin on whole steps, less than a step from it. Returns false if the
/// place is not at hand.
bool ProgramFrames::begin_at_place() {
    const auto place = program_->place_before(next_);
    is_starved_ = !place;
    if (!place) { return false; }
    AxisVector at = at_;
    for (std::size_t i = 0; i < axes_.size(); ++i) { at[axes_[i]] = (*place)[i] * steps_per_mm_[axes_[i]]; }
    planner_.begin_program_at(at);
    return true;
}

void ProgramFrames::finish(LegEnd::Kind end) {
    planner_.finish();
    end_ = end;
    is_finished_ = true;
    is_starved_ = false;
}

void ProgramFrames::read_move(const ProgramMove& move, std::uint32_t number) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        at_[axes_[i]] = move.target_mm[i] * steps_per_mm_[axes_[i]];
        to_[axes_[i]] = std::llround(at_[axes_[i]]);
    }
    const MoveSettings settings{.feed_mm_per_tick = move.feed_for(tick_s_),
                                .mode = move.mode,
                                .tolerance_mm = move.tolerance_mm,
                                .is_feed_fixed = move.is_feed_fixed};
    if (!move.arc) { return planner_.line_to_steps(at_, settings, number); }
    ArcShape arc = *move.arc;
    arc.first = axes_[arc.first];
    arc.second = axes_[arc.second];
    planner_.arc_to_steps(arc, at_, settings, number);
}

std::expected<const PathFrame*, PathStuck> ProgramFrames::next() {
    const auto frame = planner_.next();
    if (frame && *frame != nullptr) {
        events_.take_due(**frame, planner_.begins(), due_);
        forget_lines(**frame);
    }
    return frame;
}

void ProgramFrames::forget_lines(const PathFrame& frame) {
    begins_.push_back(frame.places[0].block);
    if (begins_.size() <= PathPlanner::kFramesKept) { return; }
    begins_.pop_front();
    events_.forget_before(begins_.front());
    while (next_ - lines_.size() < begins_.front()) { lines_.pop_front(); }
}

std::optional<std::int32_t> ProgramFrames::line_of(std::uint32_t block) const {
    const std::size_t first = next_ - lines_.size();
    if (block < next_ && block >= first) { return lines_[block - first]; }
    const Block* const there = program_->block(block);  // the leg's first block, before it was read
    return there == nullptr ? std::nullopt : there->line;
}

bool ProgramFrames::turn(const Overrides& overrides) {
    TurnResult result = planner_.turn(overrides);
    while (result == TurnResult::LacksPath && !is_finished_) {
        for (std::size_t n = 0; n < kBlocksAtOnce && !is_finished_; ++n) {
            if (!read_block()) { return false; }
        }
        result = planner_.turn(overrides);
    }
    return result == TurnResult::Taken;
}

}  // namespace lockstep
