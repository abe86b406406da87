// How a straight move surely brakes, by the limits of all its axes and motors.
//
// A motor that follows a curve q(s) along the way s has the acceleration q' s.. + q'' s.^2. With the limit A of the
// motor and bounds on |q'| and |q''| anywhere on the way, a deceleration of (A - |q''| v^2) / |q'| is always left at
// speed v. Where a motor follows a curve, A is the weaker of acceleration and deceleration.
#pragma once

#include <span>
#include <vector>

#include "core/indices.hpp"
#include "core/machine.hpp"

namespace lockstep {

class Braking {
public:
    /// The same at any speed, in mm/s^2.
    explicit Braking(double mm_s2) : rows_{{mm_s2, 0}} {}
    /// Of a move of these axes of the machine; the other ones rest anywhere in their travel.
    static Braking of_move(const MachineConfig& machine, std::span<const AxisIndex> axes,
                           std::span<const double> from_mm, std::span<const double> to_mm);
    /// Of any move of one axis, while the others rest anywhere.
    static Braking of_axis(const MachineConfig& machine, AxisIndex axis);

    /// mm/s^2 along the way; 0: at this speed no deceleration is sure.
    double mm_s2(double speed_mm_s) const;
    /// The deceleration does not depend on the speed.
    bool is_constant() const;

private:
    struct Way;
    /// The limit of an axis or a motor.
    struct Row {
        double at_rest_mm_s2 = 0;
        double per_square = 0;  // less for each (mm/s)^2, 1/mm
    };

    Braking(const MachineConfig& machine, const Way& way);

    std::vector<Row> rows_;
};

}  // namespace lockstep
