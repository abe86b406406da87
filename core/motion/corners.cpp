#include "core/motion/corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

constexpr double kNoSpeedLimit = std::numeric_limits<double>::infinity();

double least_acceleration(const AxisLimits& axis) { return std::min(axis.max_acceleration, axis.max_deceleration); }

/// Steps per mm by which axis i changes its course between two moves; null: it rests there.
double turn(const PathMove* before, const PathMove* after, std::size_t i) {
    return std::abs((after != nullptr ? after->slope(i) : 0) - (before != nullptr ? before->slope(i) : 0));
}

/// Moves without rest between them, and what there is at their n + 1 joints.
struct Joined {
    std::span<const PathMove> moves;
    const Entry& entry;
    std::span<const AxisLimits> limits;

    /// Of move m: the first may have gone a part of its way.
    double length(std::size_t m) const { return m == 0 ? moves[0].remaining_mm(entry.along) : moves[m].length_mm; }
    double turn_at(std::size_t j, std::size_t i) const {
        const PathMove* before = j == 0 ? entry.behind : &moves[j - 1];
        return turn(before, j == moves.size() ? nullptr : &moves[j], i);
    }
    /// Steps per tick.
    double jump(std::size_t j, std::size_t i, double speed) const {
        return j == 0 && entry.under_way() ? limits[i].start_velocity : turn_at(j, i) * speed;
    }
};

/// The speed at which no axis jumps by more than its start velocity, nor so often that it costs too much.
double joint_speed(const Joined& joined, std::size_t j) {
    const double before = j == 0 ? kNoSpeedLimit : joined.length(j - 1);
    const double after = j == joined.moves.size() ? kNoSpeedLimit : joined.length(j);
    const double mm = std::min(before, after);
    double speed = kNoSpeedLimit;
    for (std::size_t i = 0; i < joined.limits.size(); ++i) {
        const AxisLimits& axis = joined.limits[i];
        const double change = joined.turn_at(j, i);
        if (change == 0) { continue; }
        speed = std::min(
            {speed, axis.start_velocity / change, std::sqrt(kCornerShare * least_acceleration(axis) * mm / change)});
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
    double path_acceleration = kNoSpeedLimit;
    for (const Toll& t : tolls) {
        if (t.slope > 0) { path_acceleration = std::min(path_acceleration, t.acceleration / t.slope); }
    }
    const double cruise_mm = mm - top * top / (2 * path_acceleration);
    return std::all_of(tolls.begin(), tolls.end(),
                       [&](const Toll& t) { return t.jump * top <= t.acceleration * cruise_mm; });
}

/// Lowers a move's limits by what its corners use up; the speed (mm per tick) that they allow it. `apex2`: the square
/// of the speed it could reach between them; `entered`: the least it may have to be entered with, feed or not.
double charge(PathMove& move, double mm, double apex2, double entered, const Tolls& tolls,
              std::span<const AxisLimits> limits) {
    const double scale = move.mm_per_lead();
    const double top = std::max(move.limits.max_velocity * scale, entered);
    if (is_long(mm, top, tolls)) { return kNoSpeedLimit; }
    double allowed = kNoSpeedLimit;
    for (const Toll& t : tolls) {
        if (t.jump > 0) { allowed = std::min(allowed, kCornerShare * t.acceleration * mm / t.jump); }
    }
    const double speed = std::min({top, std::sqrt(apex2), allowed});
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
    return allowed;
}

/// What the speeds at the joints can be at most, whatever corners use up: out of reach is out of reach.
void limit_reach(const Joined& joined, std::vector<double>& speed) {
    const auto reach = [&](std::size_t m, double from, double acceleration) {
        return std::sqrt(from * from + 2 * acceleration * joined.moves[m].mm_per_lead() * joined.length(m));
    };
    for (std::size_t m = 0; m < joined.moves.size(); ++m) {
        speed[m + 1] = std::min(speed[m + 1], reach(m, speed[m], joined.moves[m].limits.max_acceleration));
    }
    for (std::size_t m = joined.moves.size(); m-- > 0;) {
        speed[m] = std::min(speed[m], reach(m, speed[m + 1], joined.moves[m].limits.max_deceleration));
    }
}

/// The speeds that corners and feeds allow at the joints, each for itself.
std::vector<double> speeds_at_joints(const Joined& joined) {
    const std::size_t n = joined.moves.size();
    std::vector<double> speed(n + 1);
    for (std::size_t j = 0; j <= n; ++j) {
        double top = kNoSpeedLimit;
        if (j > 0) { top = std::min(top, joined.moves[j - 1].top_speed()); }
        if (j < n) { top = std::min(top, joined.moves[j].top_speed()); }
        speed[j] = std::min(joint_speed(joined, j), std::max(top, joined.entry.least_at(j)));
    }
    if (joined.entry.speed) { speed[0] = *joined.entry.speed; }
    limit_reach(joined, speed);
    return speed;
}

}  // namespace

std::vector<double> limit_corners(std::span<PathMove> moves, const Entry& entry, std::span<const AxisLimits> limits) {
    const std::size_t n = moves.size();
    const Joined joined{moves, entry, limits};
    const std::vector<double> speed = speeds_at_joints(joined);
    std::vector<double> allowed = speed;
    for (std::size_t m = 0; m < n; ++m) {
        const double mm = joined.length(m);
        Tolls tolls;
        for (std::size_t i = 0; i < limits.size(); ++i) {
            const double jump = (joined.jump(m, i, speed[m]) + joined.jump(m + 1, i, speed[m + 1])) / 2;
            tolls.append({jump, least_acceleration(limits[i]), std::abs(moves[m].slope(i))});
        }
        const PathLimits& l = moves[m].limits;
        const double twice_mm = 2 * moves[m].mm_per_lead() * mm;
        const double apex2 = std::min(speed[m] * speed[m] + l.max_acceleration * twice_mm,
                                      speed[m + 1] * speed[m + 1] + l.max_deceleration * twice_mm);
        const double most = charge(moves[m], mm, apex2, entry.least_at(m), tolls, limits);
        allowed[m] = std::min(allowed[m], most);
        allowed[m + 1] = std::min(allowed[m + 1], most);
    }
    return allowed;
}

double braking_left(std::span<const PathMove> moves, std::size_t m, double speed, std::span<const AxisLimits> limits) {
    double left = kNoSpeedLimit;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double share = std::abs(moves[m].share(i));
        if (share == 0) { continue; }
        const PathMove* before = m == 0 ? nullptr : &moves[m - 1];
        const PathMove* after = m + 1 == moves.size() ? nullptr : &moves[m + 1];
        const double jump = (turn(before, &moves[m], i) + turn(&moves[m], after, i)) / 2 * speed;
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
