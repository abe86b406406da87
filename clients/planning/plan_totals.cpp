#include "clients/planning/plan_totals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/coordinator/path/coordination.hpp"
#include "core/coordinator/path/lai_path.hpp"
#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

void raise(double& peak, double value) { peak = std::max(peak, value); }

}  // namespace

PlanTotals::PlanTotals(const MachineConfig& machine, const AxisCounts& start)
    : machine_(machine), motors_(moving_motors_of(machine)) {
    const MotorCounts at = Kinematics(machine).motors_at(start);
    for (const MotorIndex m : motor_indices(motors_.size())) {
        const double mm = to_mm(motors_[m], static_cast<double>(at[m]));
        axes_.push_back(
            {.axis = machine.axes[*motors_[m].axis].name, .name = motors_[m].name, .min_mm = mm, .max_mm = mm});
        now_.push_back({.count = at[m], .speed = 0});
    }
}

void PlanTotals::take(const PathFrame& frame, const std::vector<MoveBegin>& begins) {
    note_begins(begins);
    for (const MotorIndex i : motor_indices(axes_.size())) { note_pieces(frame.axes[i], i); }
    ends_move_ = !corners_.empty() && corners_.back() >= frame.ticks;
    duration_ += frame.ticks;
}

/// A move ends where the next one begins.
void PlanTotals::note_begins(const std::vector<MoveBegin>& begins) {
    corners_.clear();
    if (ends_move_) { corners_.push_back(Ticks{}); }
    for (const MoveBegin& begin : begins) { corners_.push_back(Ticks{std::llround(begin.at)}); }
}

/// Notes the places around the tick at which the axis turns back, if it does, and the end.
void PlanTotals::note_way(const Piece& piece, Position from, MotorIndex motor) {
    const double turn = -piece.velocity.steps_per_tick() / piece.acceleration.steps_per_tick2();
    if (turn > 0 && turn < static_cast<double>(piece.ticks.value)) {
        const Ticks before{static_cast<std::int64_t>(turn)};
        note_place(motor, (from + piece.covered(before)).count());
        note_place(motor, (from + piece.covered(before + Ticks{1})).count());
    }
    note_place(motor, (from + piece.covered()).count());
}

void PlanTotals::note_place(MotorIndex motor, std::int64_t count) {
    AxisPlan& plan = axes_[motor];
    const double mm = to_mm(motors_[motor], static_cast<double>(count));
    plan.steps += std::abs(count - now_[motor].count);
    plan.min_mm = std::min(plan.min_mm, mm);
    plan.max_mm = std::max(plan.max_mm, mm);
    now_[motor].count = count;
}

void PlanTotals::note_pieces(const AxisTrack& track, MotorIndex motor) {
    AxisPlan& plan = axes_[motor];
    Axis& now = now_[motor];
    const double per_s = machine_.ticks_per_second();
    const double mm = 1 / motors_[motor].steps_per_mm;
    Ticks begin;
    Position at = track.from;
    for (const Piece& piece : track.body) {
        const double change = piece.acceleration.steps_per_tick2();
        const double first = piece.velocity.steps_per_tick() + change / 2;
        const double last = first + change * static_cast<double>(piece.ticks.value);
        note_jump(motor, first - now.speed, std::ranges::binary_search(corners_, begin));
        raise(plan.peak_velocity_mm_s, std::max(std::abs(first), std::abs(last)) * mm * per_s);
        raise(plan.peak_acceleration_mm_s2, std::abs(change) * mm * per_s * per_s);
        now.speed = last;
        note_way(piece, at, motor);
        at = at + piece.covered();
        begin += piece.ticks;
    }
}

/// If the speed jumps from period to period, the jumps within a move count as acceleration.
void PlanTotals::note_jump(MotorIndex motor, double change, bool is_between_moves) {
    AxisPlan& plan = axes_[motor];
    const double mm_s = std::abs(change) / motors_[motor].steps_per_mm * machine_.ticks_per_second();
    const double period_s = coordination_of(machine_).speed_period_s;
    if (period_s == 0 || is_between_moves) { return raise(plan.peak_jump_mm_s, mm_s); }
    raise(plan.peak_acceleration_mm_s2, mm_s / period_s);
}

void PlanTotals::end_leg() {
    for (const MotorIndex i : motor_indices(axes_.size())) {
        note_jump(i, now_[i].speed, true);
        now_[i].speed = 0;
    }
    ends_move_ = true;
}

}  // namespace lockstep
