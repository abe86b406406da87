#include "core/motion/piece_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/step/executable.hpp"

namespace lockstep {
namespace {

constexpr double kCheckRounding = 1e-6;     // relative: rounding of doubles to integers
constexpr double kSpeedRounding = 0x1p-46;  // steps per tick: rounding of the speeds at a piece's ends

/// The speed by which the acceleration of one tick can exceed a limit where two pieces meet, in steps per tick.
double one_tick(const AxisLimits& limits) { return 2 * std::max(limits.max_acceleration, limits.max_deceleration); }

bool within_speed(double velocity, const AxisLimits& limits) {
    return std::abs(velocity) <= limits.max_velocity * (1 + kCheckRounding) + one_tick(limits);
}

/// A piece that turns decelerates and accelerates. It must keep both limits, so that its parts keep them too.
bool within_acceleration(double before, double after, double ticks, const AxisLimits& limits) {
    const bool turns = before * after < 0 && std::min(std::abs(before), std::abs(after)) > one_tick(limits);
    const bool speeds_up = std::abs(after) > std::abs(before);
    const double most = turns       ? std::min(limits.max_acceleration, limits.max_deceleration)
                        : speeds_up ? limits.max_acceleration
                                    : limits.max_deceleration;
    return std::abs(after - before) <= most * ticks * (1 + kCheckRounding) + kSpeedRounding;
}

bool within_travel(Position at, const AxisLimits& limits) {
    return at.count() >= limits.min_steps && at.count() <= limits.max_steps;
}

bool within_strain(const Strain& strain, const AxisLimits& limits) {
    return strain.most() <= limits.start_velocity * (1 + kCheckRounding) + one_tick(limits);
}

}  // namespace

FaultCode check_pieces(std::span<const Piece> pieces, const AxisLimits& limits, MotionPoint& point) {
    const double steepest = std::max(limits.max_acceleration, limits.max_deceleration);
    for (const Piece& piece : pieces) {
        if (piece.ticks.value <= 0 || piece.ticks > kMaxPieceTicks) { return FaultCode::BadProgram; }
        if (!executable(piece)) { return FaultCode::FrameBeyondLimits; }
        const double a = piece.acceleration.steps_per_tick2();
        const double before = piece.velocity.steps_per_tick() + a / 2;
        const auto ticks = static_cast<double>(piece.ticks.value);
        const double after = before + a * ticks;
        Strain strain = point.strain;
        strain.add(before - point.velocity, 0, steepest);
        const bool fits = within_speed(before, limits) && within_speed(after, limits) &&
                          within_acceleration(before, after, ticks, limits) && within_strain(strain, limits);
        if (!fits) { return FaultCode::FrameBeyondLimits; }
        strain.add(after - before, ticks, steepest * (1 + kCheckRounding));
        point = {point.position + piece.covered(), after, strain};
        if (!within_travel(point.position, limits)) { return FaultCode::FrameOutsideTravel; }
    }
    return FaultCode::None;
}

bool may_rest(const MotionPoint& end, const AxisLimits& limits) {
    Strain strain = end.strain;
    strain.add(-end.velocity, 0, 0);
    return within_strain(strain, limits);
}

}  // namespace lockstep
