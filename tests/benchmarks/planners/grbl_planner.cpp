#include "tests/benchmarks/planners/grbl_planner.hpp"

#include "tests/benchmarks/planners/corner.hpp"

namespace lockstep::planners {
namespace {

constexpr double kStraight =
    5e-7;  // the cosine of the angle between two moves is within 1e-6 of that of a straight line

/// The bounds of one move. A name that ends in 2 is the square of a speed.
struct GrblBounds {
    double acceleration = 0;
    double cruise2 = 0;
    double change2 = 0;  // the most by which the square can change along the move
    double begin2 = 0;   // by its corner with the move before
};

/// The unit vector along the change of direction.
Vector inward(const Vector& before, const Vector& after) {
    Vector change{};
    double square = 0;
    for (std::size_t i = 0; i < kAxes; ++i) {
        change[i] = after[i] - before[i];
        square += change[i] * change[i];
    }
    for (double& part : change) { part /= std::sqrt(square); }
    return change;
}

double corner2(const Vector& before, const Vector& after, const Limits& limits, double deviation) {
    const Corner corner = corner_between(before, after);
    if (corner.cosine * corner.cosine < kStraight) { return std::numeric_limits<double>::infinity(); }
    if (corner.sine * corner.sine < kStraight) { return 0; }
    const double acceleration = most_along(inward(before, after), limits, &AxisLimit::acceleration);
    return acceleration * deviation * corner.radius_ratio();
}

std::vector<GrblBounds> all_bounds(const std::vector<StraightMove>& moves, const Limits& limits, double deviation) {
    std::vector<GrblBounds> all;
    all.reserve(moves.size());
    for (const StraightMove& move : moves) {
        const double cruise = std::min(move.feed_mm_s, most_along(move.direction, limits, &AxisLimit::max_velocity));
        GrblBounds bounds{.acceleration = most_along(move.direction, limits, &AxisLimit::acceleration),
                          .cruise2 = cruise * cruise};
        bounds.change2 = 2 * move.length_mm * bounds.acceleration;
        if (!all.empty()) {
            const Vector& before = moves[all.size() - 1].direction;
            bounds.begin2 =
                std::min({corner2(before, move.direction, limits, deviation), bounds.cruise2, all.back().cruise2});
        }
        all.push_back(bounds);
    }
    return all;
}

/// The greatest squares of the speeds at the begins of the moves in [first, end) from which the machine can rest at the
/// end of the last one. Returns that of the first move; `each` gets all.
template <typename Each>
double backward(const std::vector<GrblBounds>& bounds, std::size_t first, std::size_t end, const Each& each) {
    double next2 = 0;
    for (std::size_t k = end; k-- > first;) {
        next2 = std::min(bounds[k].begin2, next2 + bounds[k].change2);
        each(k, next2);
    }
    return next2;
}

}  // namespace

double junction_deviation_mm(const Limits& limits) {
    const Vector first{1, 0, 0};
    const Vector second{0, 1, 0};
    const double speed = std::min(limits[0].start_velocity, limits[1].start_velocity);
    return speed * speed / corner2(first, second, limits, 1);
}

Speeds plan_by_grbl(const std::vector<StraightMove>& moves, const Limits& limits, double junction_deviation_mm,
                    std::size_t blocks) {
    const std::vector<GrblBounds> bounds = all_bounds(moves, limits, junction_deviation_mm);
    const std::size_t n = moves.size();
    std::vector<double> from_end2(n + 1);  // used if all blocks are known
    if (blocks >= n) {
        backward(bounds, 0, n, [&](std::size_t k, double square) { from_end2[k] = square; });
    }
    Speeds speeds(n);
    double begin2 = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const double slowest2 =
            blocks >= n ? from_end2[k + 1] : backward(bounds, k + 1, std::min(n, k + blocks), [](auto, auto) {});
        const double end2 = std::min(slowest2, begin2 + bounds[k].change2);
        const double middle2 = (begin2 + end2 + bounds[k].change2) / 2;
        speeds[k] = {begin2, std::min(bounds[k].cruise2, middle2), end2, bounds[k].acceleration};
        begin2 = end2;
    }
    return speeds;
}

}  // namespace lockstep::planners
