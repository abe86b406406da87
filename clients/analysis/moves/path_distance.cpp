#include "clients/analysis/moves/path_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "clients/analysis/vector/clones.hpp"
#include "clients/analysis/vector/lanes.hpp"

namespace lockstep::analysis {

PathDistance::PathDistance(const AskedPath& asked) {
    counts_.assign(asked.starts().steps.begin(), asked.starts().steps.end());
    axes_ = asked.places();
    at_mm_.resize(axes_.axes());
    axes_.set(counts_, at_mm_);
    for (const AxisIndex i : axis_indices(axes_.axes())) { near_mm2_ += std::pow(axes_.kinematics()->step_mm(i), 2); }
    places_.mm.resize(axes_.axes());
}

void PathDistance::begin(const AskedPath& asked, std::size_t move) {
    move_ = move;
    shape_ = asked.shape(move);
    bound_.forget();
}

bool PathDistance::step(MotorIndex motor, std::int64_t count, int direction) {
    const bool is_next = std::exchange(counts_[motor], count) == count - direction;
    if (!is_next) { bound_.forget(); }
    axes_.go_to(motor, count, at_mm_);
    return is_next;
}

void PathDistance::measure(const AskedPath& asked, float& largest_square_mm2) {
    note_place(0);
    places_.size = 1;
    measure_places(asked, largest_square_mm2);
}

void PathDistance::measure(const AskedPath& asked, std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane,
                           float& largest_square_mm2) {
    while (!steps.empty()) {
        steps = steps.subspan(note_places(steps, motor_of_lane));
        measure_places(asked, largest_square_mm2);
    }
}

/// The square of the distance from the axes' place to the curve. Near the joint of two moves, one motor may be in a
/// later move than the others: then the nearest of the last curves counts.
double PathDistance::square_of_distance_mm2(const AskedPath& asked) {
    constexpr std::size_t kBack = 8;
    double least = shape_.square_of_distance(at_mm_);
    bound_.set(shape_);
    for (std::size_t back = 1; back <= std::min(kBack, move_) && least > near_mm2_; ++back) {
        least = std::min(least, asked.shape(move_ - back).square_of_distance(at_mm_));
    }
    return least;
}

/// Notes the places after the next steps. Returns the number of these steps.
std::size_t PathDistance::note_places(std::span<const MergedStep> steps, MotorsOfLanes motor_of_lane) {
    if (steps.size() >= Places::kMost && axes_.is_direct()) {
        note_block(steps.first<Places::kMost>(), motor_of_lane);
        return Places::kMost;
    }
    std::size_t taken = 0;
    for (places_.size = 0; places_.size < Places::kMost && taken < steps.size(); ++taken) {
        const MergedStep& step = steps[taken];
        const MotorIndex motor = *motor_of_lane[step.lane()];
        counts_[motor] += step.direction();
        axes_.go_to(motor, counts_[motor], at_mm_);
        note_place(places_.size);
        const bool ends_tick = taken + 1 == steps.size() || steps[taken + 1].tick() != step.tick();
        places_.size += ends_tick || axes_.is_direct() ? 1 : 0;
    }
    return taken;
}

/// The same for a whole block, if the motors are the axes: a motor's count after each step is the sum of its changes.
LOCKSTEP_VECTOR_CLONES
void PathDistance::note_block(std::span<const MergedStep, Places::kMost> steps, MotorsOfLanes motor_of_lane) {
    std::array<std::int32_t, Places::kMost> kinds;
    for (std::size_t i = 0; i < steps.size(); ++i) { kinds[i] = static_cast<std::int32_t>(steps[i].kind()); }
    IntLanes kind;
    load(kind, kinds.data());
    for (std::size_t i = 0; i < places_.mm.size(); ++i) {
        if (std::ranges::find(motor_of_lane, std::optional(MotorIndex{i})) == motor_of_lane.end()) {
            places_.mm[i].fill(at_mm_[i]);
        }
    }
    for (std::size_t lane = 0; lane < motor_of_lane.size(); ++lane) {
        if (!motor_of_lane[lane]) { continue; }
        const MotorIndex motor = *motor_of_lane[lane];
        const auto forward = static_cast<std::int32_t>(2 * lane);
        IntLanes sums = (kind == forward + 1) - (kind == forward);
        sum_up(sums);
        std::array<std::int32_t, Places::kMost> changes;
        store(sums, changes.data());
        const auto before = static_cast<double>(counts_[motor]);
        const double mm_per_step = axes_.mm_per_step(AxisIndex{motor.number()});  // each motor is an axis
        for (std::size_t half = 0; half < Places::kMost; half += Places::kMost / 2) {
            HalfIntLanes change;
            load(change, changes.data() + half);
            const DoubleLanes count = before + __builtin_convertvector(change, DoubleLanes);
            store(count * mm_per_step, places_.mm[motor].data() + half);
        }
        counts_[motor] += changes.back();
    }
    places_.size = Places::kMost;
}

void PathDistance::note_place(std::size_t number) {
    for (AxisIndex axis{0}; axis < at_mm_.size(); ++axis) { places_.mm[axis][number] = at_mm_[axis]; }
}

/// Measures the distances of the places that may be farther than the farthest one.
void PathDistance::measure_places(const AskedPath& asked, float& largest) {
    std::size_t place = bound_.first_farther(places_, 0, static_cast<double>(largest));
    while (place < places_.size) {
        places_.get(place, at_mm_);
        largest = std::max(largest, static_cast<float>(square_of_distance_mm2(asked)));
        place = bound_.first_farther(places_, place + 1, static_cast<double>(largest));
    }
    places_.get(places_.size - 1, at_mm_);
}

}  // namespace lockstep::analysis
