#include "clients/analysis/motors/motor_skew.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::analysis {

void MotorSkew::add(const MotorSkew& more) {
    for (const auto figure : {&MotorSkew::in_homing_mm, &MotorSkew::in_motion_mm, &MotorSkew::at_rest_mm}) {
        this->*figure = std::max(this->*figure, more.*figure);
    }
}

std::optional<double> MotorSkew::largest_mm() const { return std::max({in_homing_mm, in_motion_mm, at_rest_mm}); }

std::vector<MotorSkew> axes_with_skew(const Kinematics& kinematics) {
    std::vector<std::size_t> motors(kinematics.axes());
    for (const MotorConfig& motor : kinematics.motors()) {
        if (motor.moves_one_axis) { ++motors[*motor.axis]; }
    }
    std::vector<MotorSkew> skews;
    for (AxisIndex axis{0}; axis < motors.size(); ++axis) {
        if (motors[axis] > 1) { skews.push_back({.axis = axis}); }
    }
    return skews;
}

MotorSkewMeter::MotorSkewMeter(const Kinematics& kinematics, bool is_homing, std::span<const std::int64_t> starts)
    : is_homing_(is_homing), skews_(axes_with_skew(kinematics)) {
    if (skews_.empty()) { return; }
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        const MotorConfig& config = kinematics.motors()[m];
        Motor& motor = motors_.emplace_back();
        const auto skew = std::ranges::find(skews_, config.axis, &MotorSkew::axis);
        if (skew == skews_.end() || !config.moves_one_axis) { continue; }
        motor.of = static_cast<std::size_t>(skew - skews_.begin());
        motor.axis_mm_per_step = kinematics.axis_mm(*config.axis, m);
        if (is_homing) { motor.count = 0; }
        if (!is_homing && m < starts.size()) { motor.count = starts[m]; }
    }
}

void MotorSkewMeter::take(const MergedSteps& steps, std::span<const std::optional<MotorIndex>> motor_of_lane,
                          Tick until) {
    if (motors_.empty()) { return; }
    for (std::size_t i = 0; i < steps.lanes().size() && !is_homing_; ++i) {
        const MergedSteps::Lane& lane = steps.lanes()[i];
        if (motor_of_lane[i] && !lane.steps.empty()) { motors_[*motor_of_lane[i]].count = lane.count; }
    }
    follow(steps, motor_of_lane, until);
}

void MotorSkewMeter::follow(const MergedSteps& steps, std::span<const std::optional<MotorIndex>> motor_of_lane,
                            Tick until) {
    const auto in_motion = is_homing_ ? &MotorSkew::in_homing_mm : &MotorSkew::in_motion_mm;
    for (const MergedStep& step : steps.before(until)) {
        const auto& number = motor_of_lane[step.lane()];
        if (!number || !motors_[*number].of) { continue; }
        const Tick tick = steps.tick_of(step);
        if (newest_ && tick != *newest_) { note(in_motion); }
        if (newest_ && tick - *newest_ > kRest && !is_homing_) { note(&MotorSkew::at_rest_mm); }
        newest_ = tick;
        if (auto& count = motors_[*number].count) { *count += step.direction(); }
    }
}

const std::vector<MotorSkew>& MotorSkewMeter::finish() {
    if (newest_) {
        note(is_homing_ ? &MotorSkew::in_homing_mm : &MotorSkew::in_motion_mm);
        if (!is_homing_) { note(&MotorSkew::at_rest_mm); }
    }
    return skews_;
}

void MotorSkewMeter::add_to(std::vector<MotorSkew>& all) {
    for (const MotorSkew& of : finish()) {
        const auto known = std::ranges::find(all, of.axis, &MotorSkew::axis);
        if (known != all.end()) { known->add(of); }
    }
}

void MotorSkewMeter::note(std::optional<double> MotorSkew::*figure) {
    for (std::size_t i = 0; i < skews_.size(); ++i) { skews_[i].*figure = std::max(skews_[i].*figure, now_mm(i)); }
}

/// nullopt if the place of one of its motors is not known.
std::optional<double> MotorSkewMeter::now_mm(std::size_t skew) const {
    std::optional<double> least;
    std::optional<double> most;
    for (const Motor& motor : motors_) {
        if (motor.of != skew) { continue; }
        if (!motor.count) { return std::nullopt; }
        const double at_mm = static_cast<double>(*motor.count) * motor.axis_mm_per_step;
        least = std::min(least.value_or(at_mm), at_mm);
        most = std::max(most.value_or(at_mm), at_mm);
    }
    return most.value_or(0) - least.value_or(0);
}

}  // namespace lockstep::analysis
