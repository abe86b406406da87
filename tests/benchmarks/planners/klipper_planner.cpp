#include "tests/benchmarks/planners/klipper_planner.hpp"

#include <limits>
#include <numbers>

#include "tests/benchmarks/planners/corner.hpp"

namespace lockstep::planners {
namespace {

constexpr std::size_t kZ = 2;

/// The bounds of one move: squares of speeds, and the most by which a square can change along the move.
struct Bounds {
    double acceleration = 0;
    double cruise2 = 0;
    double change2 = 0;
    double soft_change2 = 0;  // with the reduced acceleration
    double begin2 = 0;        // as the moves before it allow
    double soft_begin2 = 0;
};

/// The squares of speeds of one move that the moves after it allow.
struct Reach {
    double begin2 = 0;
    double end2 = 0;
    double soft_begin2 = 0;
    double soft_end2 = 0;
};

Bounds bounds_of(const StraightMove& move, const KlipperSetup& setup) {
    const double share = std::abs(move.direction[kZ]);
    Bounds bounds{.acceleration = setup.max_acceleration};
    double cruise = std::min(move.feed_mm_s, setup.max_velocity);
    if (share > 0) {
        cruise = std::min(cruise, setup.max_z_velocity / share);
        bounds.acceleration = std::min(bounds.acceleration, setup.max_z_acceleration / share);
    }
    const double soft = std::min(bounds.acceleration, setup.max_acceleration * (1 - setup.minimum_cruise_ratio));
    bounds.cruise2 = cruise * cruise;
    bounds.change2 = 2 * move.length_mm * bounds.acceleration;
    bounds.soft_change2 = 2 * move.length_mm * soft;
    return bounds;
}

/// The greatest square of the speed between two moves, by their corner alone.
double corner2(const Corner& corner, const Bounds& before, const Bounds& after, const KlipperSetup& setup) {
    if (corner.is_straight()) { return std::numeric_limits<double>::infinity(); }
    const double deviation = setup.square_corner_velocity * setup.square_corner_velocity * (std::numbers::sqrt2 - 1) /
                             setup.max_acceleration;
    const double by_deviation = corner.radius_ratio() * deviation * std::min(before.acceleration, after.acceleration);
    // a l tan / 2, where change2 is 2 a l.
    const double by_length = std::min(before.change2, after.change2) * corner.tangent() / 4;
    return std::min(by_deviation, by_length);
}

std::vector<Bounds> all_bounds(const std::vector<StraightMove>& moves, const KlipperSetup& setup) {
    std::vector<Bounds> all;
    all.reserve(moves.size());
    for (const StraightMove& move : moves) {
        Bounds bounds = bounds_of(move, setup);
        if (!all.empty()) {
            const Bounds& before = all.back();
            const Corner corner = corner_between(moves[all.size() - 1].direction, move.direction);
            bounds.begin2 = std::min({corner2(corner, before, bounds, setup), bounds.cruise2, before.cruise2,
                                      before.begin2 + before.change2});
            bounds.soft_begin2 = std::min(bounds.begin2, before.soft_begin2 + before.soft_change2);
        }
        all.push_back(bounds);
    }
    return all;
}

/// Computed backward from rest at the end.
std::vector<Reach> all_reaches(const std::vector<Bounds>& bounds) {
    std::vector<Reach> all(bounds.size());
    double next2 = 0;
    double soft_next2 = 0;
    for (std::size_t k = bounds.size(); k-- > 0;) {
        all[k].end2 = next2;
        all[k].soft_end2 = soft_next2;
        next2 = all[k].begin2 = std::min(bounds[k].begin2, next2 + bounds[k].change2);
        soft_next2 = all[k].soft_begin2 = std::min(bounds[k].soft_begin2, soft_next2 + bounds[k].soft_change2);
    }
    return all;
}

/// Whether the move brakes along its whole length with the reduced acceleration.
bool only_brakes(const Bounds& bounds, const Reach& reach) {
    return reach.soft_begin2 >= reach.soft_end2 + bounds.soft_change2;
}

/// Limits moves that only brake to the peak before them. The limit falls from each move to the next.
void brake_from(double peak2, std::size_t first, std::size_t end, const std::vector<Reach>& reaches, Speeds& speeds) {
    for (std::size_t k = first; k < end; ++k) {
        peak2 = std::min(peak2, reaches[k].begin2);
        speeds[k].begin2 = speeds[k].cruise2 = peak2;
        speeds[k].end2 = std::min(reaches[k].end2, peak2);
    }
}

}  // namespace

KlipperSetup klipper_setup(const Limits& limits) {
    return {.max_velocity = std::min(limits[0].max_velocity, limits[1].max_velocity),
            .max_acceleration = std::min(limits[0].acceleration, limits[1].acceleration),
            .max_z_velocity = limits[kZ].max_velocity,
            .max_z_acceleration = limits[kZ].acceleration,
            .square_corner_velocity = std::min(limits[0].start_velocity, limits[1].start_velocity)};
}

/// The reduced acceleration gives each rise and fall of the speed a peak. A move's cruise speed is below the peak of
/// the rise that it is part of, and moves that only brake are below the peak from which they brake.
Speeds plan_by_klipper(const std::vector<StraightMove>& moves, const KlipperSetup& setup) {
    const std::vector<Bounds> bounds = all_bounds(moves, setup);
    const std::vector<Reach> reaches = all_reaches(bounds);
    Speeds speeds(moves.size());
    double peak2 = 0;
    std::size_t braking = moves.size();  // moves from k + 1 up to here only brake
    for (std::size_t k = moves.size(); k-- > 0;) {
        speeds[k].acceleration = bounds[k].acceleration;
        const Reach& reach = reaches[k];
        if (only_brakes(bounds[k], reach)) { continue; }
        const bool brakes_too = reach.soft_begin2 + bounds[k].soft_change2 > reach.soft_end2;
        if (brakes_too || braking > k + 1) {
            const double middle2 = (reach.soft_begin2 + reach.soft_end2 + bounds[k].soft_change2) / 2;
            peak2 = std::min(bounds[k].cruise2, middle2);
            brake_from(peak2, k + 1, braking, reaches, speeds);
        }
        const double hard_middle2 = (reach.begin2 + reach.end2 + bounds[k].change2) / 2;
        const double cruise2 = std::min({hard_middle2, bounds[k].cruise2, peak2});
        speeds[k].begin2 = std::min(reach.begin2, cruise2);
        speeds[k].cruise2 = cruise2;
        speeds[k].end2 = std::min(reach.end2, cruise2);
        braking = k;
    }
    return speeds;
}

}  // namespace lockstep::planners
