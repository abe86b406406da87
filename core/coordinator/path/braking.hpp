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
    /// Brakes with this deceleration at any speed, in mm/s^2.
    explicit Braking(double mm_s2) : rows_{{mm_s2, 0}} {}
    /// How a move of these axes of the machine brakes, wherever the other axes rest in their travel.
    static Braking of_move(const MachineConfig& machine, std::span<const AxisIndex> axes,
                           std::span<const double> from_mm, std::span<const double> to_mm);
    /// How any move of one axis brakes, wherever the other axes rest.
    static Braking of_axis(const MachineConfig& machine, AxisIndex axis);

    /// The deceleration along the way in mm/s^2; 0: at this speed no deceleration is sure.
    double mm_s2(double speed_mm_s) const;
    /// The deceleration does not depend on the speed.
    bool is_constant() const;

private:
    struct Way;
    /// The deceleration that the limit of an axis or a motor leaves.
    struct Row {
        double at_rest_mm_s2 = 0;
        double per_square = 0;  // 1/mm: so much less for each (mm/s)^2 of the speed
    };

    Braking(const MachineConfig& machine, const Way& way);

    std::vector<Row> rows_;
};

}  // namespace lockstep
