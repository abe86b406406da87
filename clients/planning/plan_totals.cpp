#include "clients/planning/plan_totals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/coordinator/path/lai_path.hpp"

namespace lockstep {
namespace {

/// Returns the position after the first `t` ticks of the track.
Position position_at(const AxisTrack& track, Ticks t) {
    Position at = track.from;
    for (const Piece& piece : track.body) {
        const Ticks into = std::min(t, piece.ticks);
        at = at + piece.covered(into);
        t = t - into;
    }
    return at;
}

void raise(double& peak, double value) { peak = std::max(peak, value); }

}  // namespace

PlanTotals::PlanTotals(const MachineConfig& machine, const AxisCounts& start) : machine_(machine) {
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        const double mm = to_mm(machine.axes[i], static_cast<double>(start[i]));
        axes_.push_back({.name = machine.axes[i].name, .min_mm = mm, .max_mm = mm});
        now_.push_back({.count = start[i], .speed = 0, .at = Position::steps(start[i])});
    }
}

void PlanTotals::take(const PathFrame& frame, const std::vector<MoveBegin>& begins) {
    note_begins(frame, begins);
    for (std::size_t i = 0; i < axes_.size(); ++i) { note_pieces(frame.axes[i], i); }
    ends_move_ = !corners_.empty() && corners_.back() >= frame.ticks;
    duration_ += frame.ticks;
}

/// A move ends where the next one begins. A begin at the end of a frame may be listed for the next frame again.
void PlanTotals::note_begins(const PathFrame& frame, const std::vector<MoveBegin>& begins) {
    corners_.clear();
    if (ends_move_) { corners_.push_back(Ticks{}); }
    for (const MoveBegin& begin : begins) {
        const Ticks at{std::llround(begin.at)};
        corners_.push_back(at);
        if (begin.block <= begun_) { continue; }
        begun_ = begin.block;
        for (std::size_t i = 0; i < axes_.size(); ++i) { note_place(i, position_at(frame.axes[i], at).count()); }
    }
}

void PlanTotals::note_place(std::size_t axis, std::int64_t count) {
    AxisPlan& plan = axes_[axis];
    const double mm = to_mm(machine_.axes[axis], static_cast<double>(count));
    plan.steps += std::abs(count - now_[axis].count);
    plan.min_mm = std::min(plan.min_mm, mm);
    plan.max_mm = std::max(plan.max_mm, mm);
    now_[axis].count = count;
}

void PlanTotals::note_pieces(const AxisTrack& track, std::size_t axis) {
    AxisPlan& plan = axes_[axis];
    Axis& now = now_[axis];
    const double per_s = machine_.ticks_per_second();
    const double mm = 1 / machine_.axes[axis].steps_per_mm;
    Ticks begin;
    now.at = track.from;
    for (const Piece& piece : track.body) {
        const double change = piece.acceleration.steps_per_tick2();
        const double first = piece.velocity.steps_per_tick() + change / 2;
        const double last = first + change * static_cast<double>(piece.ticks.value);
        note_jump(axis, first - now.speed, std::ranges::binary_search(corners_, begin));
        raise(plan.peak_velocity_mm_s, std::max(std::abs(first), std::abs(last)) * mm * per_s);
        raise(plan.peak_acceleration_mm_s2, std::abs(change) * mm * per_s * per_s);
        now.speed = last;
        now.at = now.at + piece.covered();
        begin += piece.ticks;
    }
}

/// With the LAI method the speed jumps from period to period. Within a move these jumps count as acceleration.
void PlanTotals::note_jump(std::size_t axis, double change, bool is_between_moves) {
    AxisPlan& plan = axes_[axis];
    const double mm_s = std::abs(change) / machine_.axes[axis].steps_per_mm * machine_.ticks_per_second();
    if (machine_.coordination != StepMethod::Lai || is_between_moves) { return raise(plan.peak_jump_mm_s, mm_s); }
    raise(plan.peak_acceleration_mm_s2, mm_s / (static_cast<double>(kLaiPeriod_ns) * 1e-9));
}

void PlanTotals::end_leg() {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        note_jump(i, now_[i].speed, true);
        note_place(i, now_[i].at.count());
        now_[i].speed = 0;
    }
    begun_ = -1;
    ends_move_ = true;
}

}  // namespace lockstep
