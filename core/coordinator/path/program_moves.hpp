// Passes the moves and dwells of a leg's blocks to a planner, in steps.
//
// The planner is a PathPlanner or a PathTimer: it has begin_program_at, line_to_steps, begin_arc_to_steps, rest and
// finish.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/path/axis_vector.hpp"
#include "core/path/primitive.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

class ProgramMoves {
public:
    explicit ProgramMoves(const MachineConfig& machine) : tick_s_(static_cast<double>(machine.tick_ns) * 1e-9) {
        for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
    }

    /// Begins a leg. `axes`: the machine's axes that the program names. `from`: where all axes stand.
    void begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const std::size_t> axes,
               std::uint32_t first, const AxisCounts& from);

    /// A block that has been read; null if there was none. At the leg's end `ends` is set.
    struct Read {
        const Block* block = nullptr;
        bool ends = false;
    };
    /// Reads the next block, or ends the leg. Returns neither if the next block is not at hand.
    template <typename Planner>
    Read read(Planner& planner);

    const ProgramBlocks& program() const { return *program_; }
    /// The number of the next block.
    std::uint32_t next() const { return next_; }
    /// The next block was not at hand.
    bool is_starved() const { return is_starved_; }
    /// Where the leg ended.
    LegEnd end() const { return {end_, next_, to_, pause_}; }

private:
    template <typename Planner>
    bool begin_at_place(Planner& planner);
    template <typename Planner>
    void pass(const ProgramMove& move, std::uint32_t number, Planner& planner);
    template <typename Planner>
    Read finish(LegEnd::Kind end, Planner& planner);

    std::shared_ptr<const ProgramBlocks> program_;
    std::vector<double> steps_per_mm_;
    std::vector<std::size_t> axes_;  // the machine's axes that the program names
    double tick_s_ = 0;
    std::uint32_t next_ = 0;
    bool has_moved_ = false;  // a move of the leg was read
    bool is_starved_ = false;
    LegEnd::Kind end_ = LegEnd::Kind::Program;
    Pause pause_;    // of end_
    AxisCounts to_;  // where the last block read leads to, whole steps
    AxisVector at_;  // the same, exactly
};

inline void ProgramMoves::begin(const std::shared_ptr<const ProgramBlocks>& program, std::span<const std::size_t> axes,
                                std::uint32_t first, const AxisCounts& from) {
    program_ = program;
    axes_.assign(axes.begin(), axes.end());
    next_ = first;
    has_moved_ = is_starved_ = false;
    end_ = LegEnd::Kind::Program;
    to_ = from;
    at_.clear();
    for (const std::int64_t count : from) { at_.append(static_cast<double>(count)); }
}

template <typename Planner>
ProgramMoves::Read ProgramMoves::read(Planner& planner) {
    if (program_->ends_before(next_)) { return finish(LegEnd::Kind::Program, planner); }
    const Block* const block = program_->block(next_);
    is_starved_ = block == nullptr;
    if (block == nullptr) { return {}; }
    if (ends_leg(*block)) {
        if (const auto* pause = std::get_if<Pause>(&block->action)) { pause_ = *pause; }
        return finish(end_by(*block), planner);
    }
    const auto* move = std::get_if<ProgramMove>(&block->action);
    if (move != nullptr && move->arc && !has_moved_ && !begin_at_place(planner)) { return {}; }
    const std::uint32_t number = next_++;
    if (const auto* dwell = std::get_if<Dwell>(&block->action)) {
        const Ticks ticks = ticks_of(*dwell, tick_s_);
        if (ticks > Ticks{}) { planner.rest(ticks, number); }
    } else if (move != nullptr) {
        has_moved_ = true;
        pass(*move, number, planner);
    }
    return {block};
}

/// Begins at the program's exact place. The axes begin on whole steps, less than a step from it. Returns false if the
/// place is not at hand.
template <typename Planner>
bool ProgramMoves::begin_at_place(Planner& planner) {
    const auto place = program_->place_before(next_);
    is_starved_ = !place;
    if (!place) { return false; }
    AxisVector at = at_;
    for (std::size_t i = 0; i < axes_.size(); ++i) { at[axes_[i]] = (*place)[i] * steps_per_mm_[axes_[i]]; }
    planner.begin_program_at(at);
    return true;
}

template <typename Planner>
ProgramMoves::Read ProgramMoves::finish(LegEnd::Kind end, Planner& planner) {
    planner.finish();
    end_ = end;
    is_starved_ = false;
    return {.ends = true};
}

template <typename Planner>
void ProgramMoves::pass(const ProgramMove& move, std::uint32_t number, Planner& planner) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        at_[axes_[i]] = move.target_mm[i] * steps_per_mm_[axes_[i]];
        to_[axes_[i]] = std::llround(at_[axes_[i]]);
    }
    const MoveSettings settings{.feed_mm_per_tick = move.feed_for(tick_s_),
                                .mode = move.mode,
                                .tolerance_mm = move.tolerance_mm,
                                .is_feed_fixed = move.is_feed_fixed};
    if (!move.arc) { return planner.line_to_steps(at_, settings, number); }
    ArcShape arc = *move.arc;
    arc.first = axes_[arc.first];
    arc.second = axes_[arc.second];
    planner.begin_arc_to_steps(arc, at_, settings, number);
}

}  // namespace lockstep
