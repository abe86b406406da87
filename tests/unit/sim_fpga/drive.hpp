// Drives a plant with the pulses of a profile that is given in mm and seconds.
#pragma once

#include <cmath>
#include <vector>

#include "core/kinematics/motors.hpp"
#include "core/step/engine.hpp"
#include "sim_fpga/plant.hpp"

namespace lockstep {

/// Constant acceleration from one speed to another, over a whole number of ticks.
struct Ramp {
    double from_mm_s = 0;
    double to_mm_s = 0;
    double seconds = 0;
};

inline Piece piece_of(const Ramp& ramp, const MotorConfig& axis) {
    constexpr double kTick_s = 1e-6;
    const double unit = axis.steps_per_mm * kTick_s * 0x1p64;
    const double ticks = std::max(1.0, std::round(ramp.seconds / kTick_s));
    const double rate = (ramp.to_mm_s - ramp.from_mm_s) / ticks * unit;
    return {Ticks{std::llround(ticks)}, {std::llround(ramp.from_mm_s * unit - rate / 2)}, {std::llround(rate)}};
}

/// From rest to `speed` and back to rest: jumps to and from `jump`, accelerates at `accel`, cruises for `seconds`.
inline std::vector<Ramp> trapezoid(double jump_mm_s, double speed_mm_s, double accel_mm_s2, double seconds) {
    const double ramp_s = std::abs(speed_mm_s - jump_mm_s) / accel_mm_s2;
    return {{jump_mm_s, speed_mm_s, ramp_s}, {speed_mm_s, speed_mm_s, seconds}, {speed_mm_s, jump_mm_s, ramp_s}};
}

/// How many steps the motor loses in the motion.
inline std::int64_t steps_lost(const MotorConfig& axis, const std::vector<Ramp>& ramps) {
    Plant plant(axis, 1000);
    StepEngine engine(Tick{1'000'000}, rest_position(0, ramps.front().from_mm_s + ramps.front().to_mm_s < 0));
    for (const Ramp& ramp : ramps) {
        engine.begin(piece_of(ramp, axis));
        engine.run(engine.now() + engine.remaining(), [&](StepEdge step) { plant.step(step); });
    }
    return std::abs(engine.position().count() - plant.encoder());
}

}  // namespace lockstep
