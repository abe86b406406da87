// The places of the motors by those of the axes, in steps. Most motors follow sums of shares of the axes; the carriages
// of a delta follow three axes by roots (core/kinematics/delta_map.hpp). A motor then corrects the errors of its screw
// (core/kinematics/screw.hpp).
#pragma once

#include <optional>
#include <utility>

#include "core/indices.hpp"
#include "core/kinematics/delta_map.hpp"
#include "core/kinematics/linear_map.hpp"
#include "core/kinematics/screw.hpp"

namespace lockstep {

/// A delta of a machine.
struct MachineDelta {
    DeltaMap map;
    std::array<AxisIndex, 3> axes;  // X, Y, Z
    std::array<MotorIndex, DeltaMap::kTowers> motors;
    std::array<double, 3> axis_steps_per_mm{};
    std::array<double, DeltaMap::kTowers> motor_steps_per_mm{};

    /// The tower of a motor.
    std::optional<std::size_t> tower_of(MotorIndex motor) const;
    std::optional<std::size_t> coordinate_of(AxisIndex axis) const;
    template <typename Places>
    DeltaMap::Point point(const Places& axis_steps) const {
        const auto mm = [&](std::size_t k) { return static_cast<double>(axis_steps[axes[k]]) / axis_steps_per_mm[k]; };
        return {mm(0), mm(1), mm(2)};
    }
};

class MotorMap {
public:
    MotorMap() = default;
    /// `shares`: for the motors of a delta the greatest slopes within the travel. `screws`: of the motors, in their
    /// steps; none: all are exact.
    MotorMap(LinearMap shares, std::optional<MachineDelta> delta = std::nullopt,  // NOLINT(google-explicit-constructor)
             std::vector<Screw> screws = {})
        : shares_(std::move(shares)), delta_(std::move(delta)), screws_(std::move(screws)) {}

    std::size_t motors() const { return shares_.motors(); }
    std::size_t axes() const { return shares_.axes(); }
    bool is_linear() const { return !delta_ && screws_.empty(); }
    const std::optional<MachineDelta>& delta() const { return delta_; }
    bool is_identity() const { return is_linear() && shares_.is_identity(); }
    /// Null if its screw is exact.
    const Screw* screw(MotorIndex motor) const {
        return screws_.empty() || screws_[motor].is_exact() ? nullptr : &screws_[motor];
    }
    /// By how much each motor moves at most if an axis moves by a step and all screws are exact, with a sign if it is
    /// the same everywhere.
    const LinearMap& shares() const { return shares_; }

    /// The place of a motor.
    template <typename Places>
    double place(MotorIndex motor, const Places& axes) const {
        const double steps = exact_place(motor, axes);
        const Screw* const own = screw(motor);
        return own == nullptr ? steps : own->motor(steps);
    }
    /// By how much a motor moves while the axes move a little from `at`, for a change of the axes.
    template <typename Places, typename Changes>
    double slope(MotorIndex motor, const Places& at, const Changes& change) const {
        const double steps = exact_slope(motor, at, change);
        const Screw* const own = screw(motor);
        return own == nullptr ? steps : own->slope(exact_place(motor, at)) * steps;
    }
    /// The place that a motor would have with an exact screw; `steps` is its place.
    double without_screw(MotorIndex motor, double steps) const {
        const Screw* const own = screw(motor);
        return own == nullptr ? steps : own->place(steps);
    }
    /// By how much more or less a motor moves at most because of its screw, as a share.
    double screw_share(MotorIndex motor) const {
        const Screw* const own = screw(motor);
        return own == nullptr ? 0 : own->most_slope();
    }
    /// Whether a motor follows a curve while the axes move in a line.
    bool is_curved(MotorIndex motor) const { return tower_of(motor) || has_bent_screw(motor); }
    /// Whether some motor's slope changes while the axes move in this direction.
    template <typename Places>
    bool bends(const Places& direction) const {
        if (delta_ && (direction[delta_->axes[0]] != 0 || direction[delta_->axes[1]] != 0)) { return true; }
        for (const MotorIndex m : motor_indices(screws_.size())) {
            if (has_bent_screw(m) && shares_.place(m, direction) != 0) { return true; }
        }
        return false;
    }
    /// The slopes at a place of the axes.
    LinearMap slopes_at(const std::vector<double>& axes) const;

    /// Joints: the motors' places without what is not linear, one for each axis, so that a linear map leads from them
    /// to the motors, with exact screws. Those of a delta are its carriages, in steps of their motors.
    LinearMap motors_by_joints() const;
    /// The place of an axis; `joint(i)` is the place of a joint.
    template <typename Joint>
    double axis_by_joints(AxisIndex axis, Joint joint) const {
        const auto coordinate = delta_ ? delta_->coordinate_of(axis) : std::nullopt;
        if (!coordinate) { return joint(axis); }
        std::array<double, DeltaMap::kTowers> heights{};
        for (std::size_t k = 0; k < heights.size(); ++k) {
            heights[k] = joint(delta_->axes[k]) / delta_->motor_steps_per_mm[k];
        }
        const DeltaMap::Point at = delta_->map.place(heights);
        return std::array{at.x, at.y, at.z}[*coordinate] * delta_->axis_steps_per_mm[*coordinate];
    }

private:
    std::optional<std::size_t> tower_of(MotorIndex motor) const {
        return delta_ ? delta_->tower_of(motor) : std::nullopt;
    }
    bool has_bent_screw(MotorIndex motor) const {
        const Screw* const own = screw(motor);
        return own != nullptr && own->most_bend() != 0;
    }
    /// The place and the slope of a motor with an exact screw.
    template <typename Places>
    double exact_place(MotorIndex motor, const Places& axes) const {
        const auto tower = tower_of(motor);
        if (!tower) { return shares_.place(motor, axes); }
        return delta_->map.height_mm(*tower, delta_->point(axes)) * delta_->motor_steps_per_mm[*tower];
    }
    template <typename Places, typename Changes>
    double exact_slope(MotorIndex motor, const Places& at, const Changes& change) const {
        const auto tower = tower_of(motor);
        if (!tower) { return shares_.place(motor, change); }
        return delta_->map.rise_mm(*tower, delta_->point(at), delta_->point(change)) *
               delta_->motor_steps_per_mm[*tower];
    }

    LinearMap shares_;
    std::optional<MachineDelta> delta_;
    std::vector<Screw> screws_;  // of each motor, in its steps; empty: all are exact
};

}  // namespace lockstep
