#include "clients/analysis/asked/axis_places.hpp"

namespace lockstep::analysis {

AxisPlaces::AxisPlaces(const MachineConfig& machine, const AxisCounts& plays)
    : kinematics_(std::make_shared<const Kinematics>(machine)), is_direct_(kinematics_->is_direct()) {
    for (const AxisConfig& axis : machine.axes) { mm_per_step_.push_back(1 / axis.steps_per_mm); }
    motors_.resize(kinematics_->moving_motors().size());
    for (MotorIndex motor{0}; motor < motors_.size(); ++motor) {
        plays_.emplace_back(kinematics_->motors()[motor].backlash);
        plays_.back().set(motor < plays.size() ? plays[motor] : 0);
        moved_.emplace_back();
        for (const AxisIndex axis : kinematics_->axes_of_motor(motor)) { moved_.back().push_back(axis); }
    }
}

void AxisPlaces::set(std::span<const std::int64_t> counts, std::span<double> at_mm) {
    for (MotorIndex motor{0}; motor < motors_.size(); ++motor) {
        motors_[motor] = Position::steps(counts[motor] - plays_[motor].steps());
    }
    for (AxisIndex axis{0}; axis < axes(); ++axis) { place(axis, at_mm); }
}

void AxisPlaces::go_by_map(MotorIndex motor, std::int64_t count, std::span<double> at_mm) {
    Play& play = plays_[motor];
    play.follow(count - motors_[motor].count() - play.steps());
    motors_[motor] = Position::steps(count - play.steps());
    for (const AxisIndex axis : moved_[motor]) { place(axis, at_mm); }
}

}  // namespace lockstep::analysis
