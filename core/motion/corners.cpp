#include "core/motion/corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

double least_acceleration(const AxisLimits& axis) { return std::min(axis.max_acceleration, axis.max_deceleration); }

/// Steps per mm by which axis i changes its course at joint j; before the first move and behind the last it rests.
double turn(std::span<const PathMove> moves, std::size_t j, std::size_t i) {
    const double before = j == 0 ? 0 : moves[j - 1].slope(i);
    const double after = j == moves.size() ? 0 : moves[j].slope(i);
    return std::abs(after - before);
}

/// What is left of move m: the first may be on its way already.
double length_of(std::span<const PathMove> moves, std::size_t m, double first_mm) {
    return m == 0 ? first_mm : moves[m].length_mm;
}

/// The speed at which no axis jumps by more than its start velocity, nor so often that it costs too much.
double joint_speed(std::span<const PathMove> moves, std::size_t j, double first_mm,
                   std::span<const AxisLimits> limits) {
    const double before = j == 0 ? kUnbounded : length_of(moves, j - 1, first_mm);
    const double after = j == moves.size() ? kUnbounded : length_of(moves, j, first_mm);
    const double mm = std::min(before, after);
    double speed = kUnbounded;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double change = turn(moves, j, i);
        if (change == 0) { continue; }
        speed = std::min({speed, limits[i].start_velocity / change,
                          std::sqrt(kCornerShare * least_acceleration(limits[i]) * mm / change)});
    }
    return speed;
}

/// What both joints of one move ask of one axis: the mean of their jumps, in steps per tick.
struct Toll {
    double jump = 0;
    double acceleration = 0;  // the axis's, steps per tick^2
    double slope = 0;         // steps per mm
};

using Tolls = StaticVector<Toll, kMaxAxes>;

/// Whether a move of `mm` at up to `top` cannot speed up or brake for so long that its corners are not paid for.
bool is_long(double mm, double top, const Tolls& tolls) {
    double path_acceleration = kUnbounded;
    for (const Toll& t : tolls) {
        if (t.slope > 0) { path_acceleration = std::min(path_acceleration, t.acceleration / t.slope); }
    }
    const double cruise_mm = mm - top * top / (2 * path_acceleration);
    return std::all_of(tolls.begin(), tolls.end(),
                       [&](const Toll& t) { return t.jump * top <= t.acceleration * cruise_mm; });
}

/// Lowers a move's limits by what its corners use up. `apex2`: the square of the speed it could reach between them.
void charge(PathMove& move, double mm, double apex2, const Tolls& tolls, std::span<const AxisLimits> limits) {
    const double scale = move.mm_per_lead();
    const double top = move.limits.max_velocity * scale;
    if (is_long(mm, top, tolls)) { return; }
    double speed = std::min(top, std::sqrt(apex2));
    for (const Toll& t : tolls) {
        if (t.jump > 0) { speed = std::min(speed, kCornerShare * t.acceleration * mm / t.jump); }
    }
    move.limits.max_velocity = std::min(move.limits.max_velocity, speed / scale);
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double share = std::abs(move.share(i));
        if (share == 0) { continue; }
        const double used = tolls[i].jump * speed / mm;
        move.limits.max_acceleration =
            std::min(move.limits.max_acceleration, (limits[i].max_acceleration - used) / share);
        move.limits.max_deceleration =
            std::min(move.limits.max_deceleration, (limits[i].max_deceleration - used) / share);
    }
}

/// What the speeds at the joints can be at most, whatever corners use up: out of reach is out of reach.
void limit_reach(std::span<const PathMove> moves, double first_mm, std::vector<double>& speed) {
    const auto reach = [&](std::size_t m, double from, double acceleration) {
        const double mm = length_of(moves, m, first_mm);
        return std::sqrt(from * from + 2 * acceleration * moves[m].mm_per_lead() * mm);
    };
    for (std::size_t m = 0; m < moves.size(); ++m) {
        speed[m + 1] = std::min(speed[m + 1], reach(m, speed[m], moves[m].limits.max_acceleration));
    }
    for (std::size_t m = moves.size(); m-- > 0;) {
        speed[m] = std::min(speed[m], reach(m, speed[m + 1], moves[m].limits.max_deceleration));
    }
}

}  // namespace

std::vector<double> limit_corners(std::span<PathMove> moves, Displacement along, std::span<const AxisLimits> limits) {
    const std::size_t n = moves.size();
    const double first_mm = moves[0].remaining_mm(along);
    std::vector<double> speed(n + 1);
    for (std::size_t j = 0; j <= n; ++j) {
        speed[j] = joint_speed(moves, j, first_mm, limits);
        if (j > 0) { speed[j] = std::min(speed[j], moves[j - 1].top_speed()); }
        if (j < n) { speed[j] = std::min(speed[j], moves[j].top_speed()); }
    }
    limit_reach(moves, first_mm, speed);
    for (std::size_t m = 0; m < n; ++m) {
        const double mm = length_of(moves, m, first_mm);
        Tolls tolls;
        for (std::size_t i = 0; i < limits.size(); ++i) {
            const double jump = (turn(moves, m, i) * speed[m] + turn(moves, m + 1, i) * speed[m + 1]) / 2;
            (void)tolls.push_back({jump, least_acceleration(limits[i]), std::abs(moves[m].slope(i))});
        }
        const PathLimits& l = moves[m].limits;
        const double twice_mm = 2 * moves[m].mm_per_lead() * mm;
        const double apex2 = std::min(speed[m] * speed[m] + l.max_acceleration * twice_mm,
                                      speed[m + 1] * speed[m + 1] + l.max_deceleration * twice_mm);
        charge(moves[m], mm, apex2, tolls, limits);
    }
    return speed;
}

double braking_left(std::span<const PathMove> moves, std::size_t m, double speed, std::span<const AxisLimits> limits) {
    double left = kUnbounded;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double share = std::abs(moves[m].share(i));
        if (share == 0) { continue; }
        const double jump = (turn(moves, m, i) + turn(moves, m + 1, i)) / 2 * speed;
        left = std::min(left, (limits[i].max_deceleration - jump * speed / moves[m].length_mm) / share);
    }
    return left;
}

double rest_share(Ticks rest, std::span<const AxisLimits> limits) {
    double share = 1;
    for (const AxisLimits& axis : limits) {
        const double paid = least_acceleration(axis) * static_cast<double>(rest.value) / axis.start_velocity;
        share = std::min(share, (1 + paid) / 2);
    }
    return share;
}

}  // namespace lockstep
