// Klipper's look-ahead, written anew after its document Kinematics. It was not compared with Klipper itself.
//
// - One velocity and one acceleration along the path. The limits of the third axis, divided by its share of a move's
//   direction, slow the move down.
// - A corner's speed by square_corner_velocity, and by the lengths of the moves beside it: an arc that touches their
//   middles needs the centripetal acceleration.
// - minimum_cruise_ratio: a move reaches a speed only if it could speed up to it and brake again with an acceleration
//   reduced by this share. The ramps themselves use the full acceleration.
// All moves are known in advance, as when Klipper prints from its own disk.
#pragma once

#include "tests/benchmarks/planners/trapezoid.hpp"

namespace lockstep::planners {

struct KlipperSetup {
    double max_velocity = 0;  // mm/s, mm/s^2, along the path
    double max_acceleration = 0;
    double max_z_velocity = 0;
    double max_z_acceleration = 0;
    double square_corner_velocity = 0;
    double minimum_cruise_ratio = 0.5;  // Klipper's default
};

/// The greatest velocity and acceleration along the path that keep the limits of the first two axes in every direction,
/// and their start velocity as the speed of a right angle.
KlipperSetup klipper_setup(const Limits& limits);

Speeds plan_by_klipper(const std::vector<StraightMove>& moves, const KlipperSetup& setup);

}  // namespace lockstep::planners
