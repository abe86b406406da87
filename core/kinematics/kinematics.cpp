#include "core/kinematics/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kMostSteps = 0x1p52;  // without a place of the tool, motors may place an axis anywhere

/// How far an axis moves at most if each motor moves by one step, in steps, with these shares of the motors.
double steps_of(const LinearMap& axes, AxisIndex axis) {
    double steps = 0;
    for (const double share : axes.row(axis)) { steps += std::abs(share); }
    return steps;
}

}  // namespace

Kinematics::Kinematics(const MachineConfig& machine)
    : motors_(lockstep::motors_of(machine)),
      axis_names_(machine.axis_names()),
      map_(step_map_of(machine)),
      inverse_(map_.motors_by_joints().inverse().value_or(LinearMap(map_.axes(), map_.motors()))),
      is_direct_(map_.is_identity() && !has_backlash(machine)) {
    for (const AxisIndex i : axis_indices(map_.axes())) {
        axis_steps_per_mm_.push_back(machine.axes[i].steps_per_mm);
        own_motors_.push_back(find_own_motor(i));
        steps_mm_.push_back(step_mm_of(i, machine));
        rest_steps_.push_back(find_rest_steps(i));
    }
}

MotorCounts Kinematics::motors_at(const AxisCounts& axes) const {
    MotorCounts motors;
    if (is_direct_) {
        motors.steps = axes;
    } else {
        for (const MotorIndex m : motor_indices(map_.motors())) {
            motors.steps.append(std::llround(map_.place(m, axes)));
        }
    }
    for (std::size_t board = map_.motors(); board < motors_.size(); ++board) { motors.steps.append(0); }
    return motors;
}

AxisCounts Kinematics::axes_at(const MotorCounts& motors) const {
    AxisCounts axes;
    if (is_direct_) {
        axes = motors.steps;
        while (axes.size() > map_.axes()) { axes.pop_back(); }
        return axes;
    }
    StaticVector<double, kMaxAxes> places;
    for (const MotorIndex m : motor_indices(map_.motors())) {
        places.append(map_.without_screw(m, static_cast<double>(motors[m])));
    }
    for (const AxisIndex i : axis_indices(inverse_.motors())) {
        const double steps = map_.axis_by_joints(i, [&](std::size_t j) { return inverse_.place(j, places); });
        const std::int64_t nearest = std::llround(std::clamp(steps, -kMostSteps, kMostSteps));
        axes.append(moves_alone(i) ? place_of_all(i, nearest, motors) : nearest);
    }
    return axes;
}

/// Its motors follow no other axis.
bool Kinematics::moves_alone(AxisIndex axis) const {
    for (const MotorIndex m : motor_indices(map_.motors())) {
        if (map_.shares().factor(m, axis) != 0 && map_.shares().only_axis_of(m) != axis) { return false; }
    }
    return true;
}

/// Motors with different steps rest at different places of their axis. Looks around the mean for one that rounds to
/// all of them.
std::int64_t Kinematics::place_of_all(AxisIndex axis, std::int64_t mean, const MotorCounts& motors) const {
    const auto is_of_all = [&](std::int64_t place) {
        for (const MotorIndex m : motor_indices(map_.motors())) {
            const double share = map_.shares().factor(m, axis);
            const double steps = share * static_cast<double>(place);
            const Screw* const screw = map_.screw(m);
            if (share != 0 && std::llround(screw == nullptr ? steps : screw->motor(steps)) != motors[m]) {
                return false;
            }
        }
        return true;
    };
    for (std::int64_t off = 0; off <= rest_steps(axis); ++off) {
        for (const std::int64_t place : {mean + off, mean - off}) {
            if (is_of_all(place)) { return place; }
        }
    }
    return mean;
}

/// The steps of its motors are its own.
bool Kinematics::rests_on_its_steps(AxisIndex axis) const {
    for (const MotorIndex m : motor_indices(map_.motors())) {
        const double share = std::abs(map_.shares().factor(m, axis));
        if (share != 0 && (share != 1 || map_.screw(m) != nullptr)) { return false; }
    }
    return moves_alone(axis);
}

std::int64_t Kinematics::find_rest_steps(AxisIndex axis) const {
    if (rests_on_its_steps(axis)) { return 0; }
    return static_cast<std::int64_t>(std::ceil(steps_mm_[axis] * axis_steps_per_mm_[axis] / 2 + 0.5));
}

double Kinematics::axis_steps(AxisIndex axis, std::span<const Position> motors) const {
    if (is_direct_) { return motors[axis].as_steps(); }
    return map_.axis_by_joints(axis, [&](std::size_t joint) {
        double sum = 0;
        for (const MotorIndex m : motor_indices(map_.motors())) {
            const double share = inverse_.factor(joint, m);
            if (share != 0) { sum += share * map_.without_screw(m, motors[m].as_steps()); }
        }
        return sum;
    });
}

double Kinematics::axis_speed(AxisIndex axis, std::span<const Position> motors, std::span<const double> speeds) const {
    const auto speed = [&](const LinearMap& axes) {
        double sum = 0;
        for (const MotorIndex m : motor_indices(map_.motors())) { sum += axes.factor(axis, m) * speeds[m]; }
        return sum;
    };
    if (map_.is_linear()) { return speed(inverse_); }
    std::vector<double> at;
    for (const AxisIndex i : axis_indices(axes())) { at.push_back(axis_steps(i, motors)); }
    const auto axes = map_.slopes_at(at).inverse();
    return axes ? speed(*axes) : 0;
}

/// Screws count with their steepest error. For a delta the most at a corner of the travel.
double Kinematics::step_mm_of(AxisIndex axis, const MachineConfig& machine) const {
    const double steps_per_mm = machine.axes[axis].steps_per_mm;
    if (!map_.delta()) {
        double steps = 0;
        for (const MotorIndex m : motor_indices(map_.motors())) {
            steps += std::abs(inverse_.factor(axis, m)) / (1 - map_.screw_share(m));
        }
        return steps / steps_per_mm;
    }
    double most = 0;
    constexpr std::size_t kCorners = 4;
    const std::array<AxisIndex, 3>& delta = map_.delta()->axes;
    for (std::size_t corner = 0; corner < kCorners; ++corner) {
        std::vector<double> at(axes());
        for (std::size_t k = 0; k < 2; ++k) {
            const AxisConfig& side = machine.axes[delta[k]];
            at[delta[k]] = ((corner >> k & 1) != 0 ? side.position_max_mm : side.position_min_mm) * side.steps_per_mm;
        }
        if (const auto axes = map_.slopes_at(at).inverse()) { most = std::max(most, steps_of(*axes, axis)); }
    }
    return most / steps_per_mm;
}

std::optional<MotorAstray> Kinematics::astray(const MotorCounts& motors) const {
    if (is_direct_) { return std::nullopt; }
    const MotorCounts placed = motors_at(axes_at(motors));
    for (const MotorIndex m : motor_indices(map_.motors())) {
        const std::int64_t off = motors[m] - placed[m];
        if (off != 0) { return MotorAstray{m, to_mm(motors_[m], static_cast<double>(off))}; }
    }
    return std::nullopt;
}

MotorSet Kinematics::motors_of_axes(AxisSet axes) const {
    MotorSet motors;
    for (const MotorIndex m : motor_indices(map_.motors())) {
        for (const AxisIndex i : axes) {
            if (map_.shares().factor(m, i) != 0) { motors.insert(m); }
        }
    }
    return motors;
}

AxisSet Kinematics::axes_of_motor(MotorIndex motor) const {
    AxisSet axes;
    if (motors_[motor].is_board()) { return axes; }
    for (const AxisIndex i : axis_indices(map_.axes())) {
        if (map_.shares().factor(motor, i) != 0) { axes.insert(i); }
    }
    return axes;
}

std::vector<std::string> Kinematics::names_of_axes(AxisSet axes) const {
    std::vector<std::string> names;
    for (const AxisIndex axis : axes) { names.push_back(axis_names_[axis]); }
    return names;
}

std::optional<MotorIndex> Kinematics::find_own_motor(AxisIndex axis) const {
    std::optional<MotorIndex> own;
    for (const MotorIndex m : motor_indices(map_.motors())) {
        const double share = map_.shares().factor(m, axis);
        if (share == 0) { continue; }
        const double with_screw = motors_[m].steps_per_mm / axis_steps_per_mm_[axis];  // the axis has finer steps
        const bool follows = share == 1 || (map_.screw(m) != nullptr && share == with_screw);
        const bool has_play = !motors_[m].backlash.is_none();
        if (own || !follows || has_play || map_.shares().only_axis_of(m) != axis) { return std::nullopt; }
        own = m;
    }
    return own;
}

std::string Kinematics::needs_frames(AxisIndex axis) const {
    std::string names;
    for (const MotorIndex m : motors_of_axes({axis})) { names += (names.empty() ? "" : ", ") + motors_[m].name; }
    return "axis " + axis_names_[axis] + " moves only on a path, because its motors must move together: " + names;
}

bool Kinematics::is_named_as_axis(MotorIndex motor) const {
    const MotorConfig& config = motors_[motor];
    return config.axis && own_motor(*config.axis) == motor && config.name == axis_names_[*config.axis];
}

std::string Kinematics::label(MotorIndex motor) const {
    const char* const kind = motors_[motor].is_board() ? "board " : is_named_as_axis(motor) ? "axis " : "motor ";
    return kind + motors_[motor].name;
}

}  // namespace lockstep
