#include "core/coordinator/path/program_moves.hpp"

#include <algorithm>
#include <cmath>

#include "core/arc_path.hpp"

namespace lockstep {

void ProgramMoves::begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const AxisIndex> axes,
                         std::uint32_t first, const AxisCounts& from) {
    program_ = program;
    axes_.assign(axes.begin(), axes.end());
    next_ = first;
    has_moved_ = is_starved_ = false;
    end_ = {};
    from_ = from;
    rest_.reset();
    at_.clear();
    for (const std::int64_t count : from) { at_.append(static_cast<double>(count)); }
}

ProgramMoves::Read ProgramMoves::read(PathInput& path) {
    if (program_->ends_before(next_)) { return finish(path); }
    const Block* const block = program_->block(next_);
    is_starved_ = block == nullptr;
    if (block == nullptr) { return {}; }
    if (ends_leg(*block)) {
        note_end(*block, end_);
        return finish(path);
    }
    const auto* move = std::get_if<ProgramMove>(&block->action);
    if (move != nullptr && move->arc && !has_moved_ && !begin_at_place(path)) { return {}; }
    const std::uint32_t number = next_++;
    if (const auto* dwell = std::get_if<Dwell>(&block->action)) {
        const Ticks ticks = ticks_of(*dwell, tick_s_);
        if (ticks > Ticks{}) { path.rest(std::max(ticks, pace_.next_rest()), number); }
    } else if (const auto* event = std::get_if<ProgramEvent>(&block->action)) {
        pace_.add(*event);
    } else if (move != nullptr) {
        has_moved_ = true;
        pass(*move, number, path);
    }
    return {block};
}

/// Begins at the program's exact place. The axes begin on whole steps, less than a step from it. Returns false if the
/// place is not at hand.
bool ProgramMoves::begin_at_place(PathInput& path) {
    const auto place = program_->place_before(next_);
    is_starved_ = !place;
    if (!place) { return false; }
    PlaceVector at = at_;
    for (std::size_t i = 0; i < axes_.size(); ++i) { at[axes_[i]] = (*place)[i] * steps_per_mm_[axes_[i]]; }
    path.begin_program_at(at);
    return true;
}

ProgramMoves::Read ProgramMoves::finish(PathInput& path) {
    path.finish();
    is_starved_ = false;
    return {.ends = true};
}

AxisCounts ProgramMoves::rest() const {
    if (!rest_) { return from_; }
    AxisCounts to = from_;
    for (const AxisIndex axis : axes_) { to[axis] = std::llround((*rest_)[axis]); }
    return within_travel(to, limits_);
}

/// Sets the way of each axis, and returns the length in mm.
double ProgramMoves::measure(const ProgramMove& move) {
    from_mm_.clear();
    for (const AxisIndex axis : axes_) { from_mm_.push_back(at_[axis] / steps_per_mm_[axis]); }
    const double length = length_mm(move, from_mm_);
    way_mm_.assign(at_.size(), 0);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const bool turns = move.arc && (i == move.arc->first || i == move.arc->second);
        way_mm_[axes_[i]] = turns ? length : std::abs(move.target_mm[i] - from_mm_[i]);
    }
    return length;
}

void ProgramMoves::pass(const ProgramMove& move, std::uint32_t number, PathInput& path) {
    const double length = pace_.is_pending() ? measure(move) : 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) { at_[axes_[i]] = move.target_mm[i] * steps_per_mm_[axes_[i]]; }
    if (pace_.is_pending() && OutputPace::is_left_out(length) && move.mode == PathMode::ExactStop) {
        return path.rest(pace_.next_rest(), number);
    }
    rest_ = at_;
    const MoveSettings settings{.feed_mm_per_tick = move.feed_for(tick_s_),
                                .mode = move.mode,
                                .tolerance_mm = move.tolerance_mm,
                                .is_feed_fixed = move.is_feed_fixed,
                                .most_mm_per_tick = pace_.next_move(length, way_mm_)};
    if (!move.arc) { return path.line_to_steps(at_, settings, number); }
    ArcShape arc = *move.arc;
    arc.first = axes_[arc.first];
    arc.second = axes_[arc.second];
    path.begin_arc_to_steps(arc, at_, settings, number);
}

}  // namespace lockstep
