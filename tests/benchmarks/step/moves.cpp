#include "tests/benchmarks/step/moves.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::bench {
namespace {

/// The time to cover s from speed v at acceleration a.
double time_to_cover(double s, double v, double a) { return 2 * s / (v + std::sqrt(v * v + 2 * a * s)); }

std::int64_t raw(double steps) { return std::llround(steps * 0x1p64); }

}  // namespace

double Trapezoid::time_of(double s) const {
    const double a = (top_velocity - start_velocity) / rise;
    const double ramp = (start_velocity + top_velocity) / 2 * rise;
    const double end = 2 * ramp + top_velocity * cruise;
    if (s <= ramp) { return time_to_cover(s, start_velocity, a); }
    return s <= end - ramp ? rise + (s - ramp) / top_velocity : duration() - time_to_cover(end - s, start_velocity, a);
}

Trapezoid continuous(const Limits& limits) {
    const double v0 = limits.start_velocity / kTicksPerSecond;
    const double a = limits.acceleration / kTicksPerSecond / kTicksPerSecond;
    const auto n = static_cast<double>(limits.steps);
    const double top = std::min(limits.max_velocity / kTicksPerSecond, std::sqrt(v0 * v0 + a * n));
    const double rise = (top - v0) / a;
    return {v0, top, rise, std::max(0.0, (n - (v0 + top) * rise) / top)};
}

Trapezoid in_whole_ticks(const Limits& limits) {
    const Trapezoid ideal = continuous(limits);
    const double rise = std::ceil(ideal.rise);
    const double cruise = std::ceil(ideal.duration() - 1e-6) - 2 * rise;
    Trapezoid plan{ideal.start_velocity, 0, rise, std::max(0.0, cruise)};
    plan.top_velocity = (static_cast<double>(limits.steps) - plan.start_velocity * rise) / (rise + plan.cruise);
    return plan;
}

std::vector<Piece> pieces_of(const Trapezoid& plan) {
    const double a = (plan.top_velocity - plan.start_velocity) / plan.rise;
    const auto ticks = [](double t) { return Ticks{std::llround(t)}; };
    std::vector<Piece> pieces{{ticks(plan.rise), {raw(plan.start_velocity - a / 2)}, {raw(a)}}};
    if (plan.cruise > 0) { pieces.push_back({ticks(plan.cruise), {raw(plan.top_velocity)}, {0}}); }
    pieces.push_back({ticks(plan.rise), {raw(plan.top_velocity + a / 2)}, {-raw(a)}});
    return pieces;
}

}  // namespace lockstep::bench
