// The speed profile of one straight move along its path: rise, cruise, fall, in integers from end to end.
//
// Path positions count the lead axis (the one with the most steps) in 2^-64 steps, from 0 to its N. Times count
// subticks, 2^-16 tick, so that moves joined at speed need not wait for a whole tick; a move from rest to rest is
// planned in whole ticks. A phase is anchored at both of its ends, so rounding errors do not accumulate.
#pragma once

#include <expected>

#include "core/static_vector.hpp"
#include "core/units.hpp"

namespace lockstep {

/// Time along a path, in 2^-16 tick.
struct Subticks {
    std::int64_t value = 0;
    constexpr auto operator<=>(const Subticks&) const = default;
    constexpr Subticks operator+(Subticks o) const { return {value + o.value}; }
    constexpr Subticks operator-(Subticks o) const { return {value - o.value}; }
    constexpr Ticks floor() const { return {value >> 16}; }
    constexpr Ticks ceil() const { return {(value + 0xffff) >> 16}; }
};
inline constexpr std::int64_t kSubticksPerTick = 1 << 16;
constexpr Subticks subticks(Ticks t) { return {t.value * kSubticksPerTick}; }

/// Constant acceleration from one place on the path to another.
struct ProfilePhase {
    Displacement from;
    Displacement to;
    std::int64_t entry = 0;  // speed at its start, 2^-64 step per subtick
    Subticks duration;       // > 0

    /// Exact: s = from + v t + (to - from - v n) (t/n)^2.
    Displacement at(Subticks t) const;
    /// Speed in steps per tick, and acceleration in steps per tick^2.
    double velocity_at(Subticks t) const;
    double acceleration() const;
};

struct Profile {
    StaticVector<ProfilePhase, 3> phases;

    Subticks duration() const;
    Displacement at(Subticks t) const;
    double velocity_at(Subticks t) const;
    double peak_velocity() const;
};

/// The limits of a profile along the path, in steps of the lead axis and ticks.
struct PathLimits {
    double start_velocity = 0;  // speed of a jump from rest, and of one to rest
    double max_velocity = 0;
    double max_acceleration = 0;
    double max_deceleration = 0;
};

struct ProfileRequest {
    Displacement from;  // on the path; from < to
    Displacement to;
    double entry = 0;  // steps per tick; each end speed must be reachable from the other
    double exit = 0;
    PathLimits limits;
    std::int64_t quantum = kSubticksPerTick;  // phases last whole multiples of it: a tick, or 1 subtick
};

/// The fastest profile in whole quanta: at most two quanta slower than the continuous optimum, never faster and never
/// steeper. The peak is solved again for the rounded times. If entered above max_velocity it first brakes to that.
Profile plan_fastest(const ProfileRequest& request);

/// Constant deceleration over the whole of [from, to], from speed `entry` to `exit` (steps per tick), rounded to the
/// gentler side.
Profile plan_brake_through(Displacement from, Displacement to, double entry, double exit);

/// Constant deceleration from speed `entry` to 0; its end on the path is not prescribed. It does not jump to rest,
/// since a corner may be just behind. It begins `start` after a whole tick, ends on a whole tick and contains at least
/// two whole ticks.
Profile plan_brake_to(Displacement from, double entry, double deceleration, Subticks start);

/// Constant speed from one place to another.
Profile plan_steady(Displacement from, Displacement to, Ticks ticks);

/// Rest at a place for a time.
Profile plan_dwell(Displacement at, Ticks ticks);

/// A move cannot be made in the requested time. These would be possible:
struct Infeasible {
    Ticks least_ticks;     // for the requested distance
    Displacement longest;  // in the requested time
};

/// A move of `distance` from rest to rest in exactly `ticks`, with the least acceleration: Pramod Ranade, "Linear motor
/// control without the math", planning of triangular and trapezoidal moves:
///   v_avg = N/T;  triangle: v_top = 2 v_avg - v_start, a = 2 (v_top - v_start)/T;
///   if v_top would exceed the limit, a trapezoid at the limit: a = (v_max - v_start)/t1, t1 = (v_max T - N)/(v_max -
///   v_start).
/// Below the start velocity the speed is constant. Acceleration and deceleration are equal, within the smaller limit.
std::expected<Profile, Infeasible> plan_in_time(Displacement distance, Ticks ticks, const PathLimits& limits);

}  // namespace lockstep
