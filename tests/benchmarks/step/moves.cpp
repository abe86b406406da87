#include "tests/benchmarks/step/moves.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/interpolate.hpp"
#include "core/motion/profile.hpp"

namespace lockstep::bench {
namespace {

/// The time to cover s from speed v at acceleration a.
double time_to_cover(double s, double v, double a) { return 2 * s / (v + std::sqrt(v * v + 2 * a * s)); }

PathLimits path_limits(const Limits& limits) {
    const double acceleration = limits.acceleration / kTicksPerSecond / kTicksPerSecond;
    return {limits.start_velocity / kTicksPerSecond, limits.max_velocity / kTicksPerSecond, acceleration, acceleration};
}

Profile plan(const Limits& limits) {
    const PathLimits path = path_limits(limits);
    return plan_fastest({{}, Displacement::steps(limits.steps), path.start_velocity, path.start_velocity, path});
}

}  // namespace

double Trapezoid::time_of(double s) const {
    const double risen = (start_velocity + top_velocity) / 2 * rise;
    const double falls = (start_velocity + top_velocity) / 2 * fall;
    const double end = risen + top_velocity * cruise + falls;
    if (s <= risen) { return time_to_cover(s, start_velocity, (top_velocity - start_velocity) / rise); }
    if (s <= end - falls) { return rise + (s - risen) / top_velocity; }
    return duration() - time_to_cover(end - s, start_velocity, (top_velocity - start_velocity) / fall);
}

Trapezoid continuous(const Limits& limits) {
    const double v0 = limits.start_velocity / kTicksPerSecond;
    const double a = limits.acceleration / kTicksPerSecond / kTicksPerSecond;
    const auto n = static_cast<double>(limits.steps);
    const double top = std::min(limits.max_velocity / kTicksPerSecond, std::sqrt(v0 * v0 + a * n));
    const double rise = (top - v0) / a;
    return {v0, top, rise, std::max(0.0, (n - (v0 + top) * rise) / top), rise};
}

Trapezoid in_whole_ticks(const Limits& limits) {
    const Profile profile = plan(limits);
    const auto ticks = [](const ProfilePhase& phase) { return static_cast<double>(phase.duration.ceil().value); };
    const bool is_triangle = profile.phases.size() == 2;
    return {limits.start_velocity / kTicksPerSecond, profile.peak_velocity(), ticks(profile.phases.front()),
            is_triangle ? 0 : ticks(profile.phases[1]), ticks(profile.phases.back())};
}

std::vector<Piece> pieces_of(const Limits& limits) {
    return lockstep::pieces_of(plan(limits), rest_position(0, false), +1);
}

}  // namespace lockstep::bench
