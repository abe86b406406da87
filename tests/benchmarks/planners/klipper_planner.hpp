// Klipper's look-ahead, restated; its document Kinematics describes it. Not compared with Klipper itself.
//
// - One velocity and one acceleration along the path, and limits of the third axis that slow a move down by its share.
// - A corner's speed by square_corner_velocity, and by the lengths of the moves beside it: an arc that touches their
//   middles needs the centripetal acceleration.
// - minimum_cruise_ratio: a speed is only reached if the way up to it and down again can be gone with an acceleration
//   reduced by this share. The ramps themselves have the full one.
// All moves are known, as when it prints from its own disk.
#pragma once

#include "tests/benchmarks/planners/trapezoid.hpp"

namespace lockstep::planners {

struct KlipperSetup {
    double max_velocity = 0;  // mm/s, mm/s^2, along the path
    double max_acceleration = 0;
    double max_z_velocity = 0;
    double max_z_acceleration = 0;
    double square_corner_velocity = 0;
    double minimum_cruise_ratio = 0.5;  // its default
};

/// The greatest velocity and acceleration along the path that keep the first two axes' limits in every direction, and
/// the start velocity of these as the speed of a right angle.
KlipperSetup klipper_setup(const Limits& limits);

Speeds plan_by_klipper(const std::vector<StraightMove>& moves, const KlipperSetup& setup);

}  // namespace lockstep::planners
