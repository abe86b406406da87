#include "core/motion/lookahead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/motion/corners.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// How much of a squared speed the move can take away or add over a length: 2 a s.
double brakes(const PathMove& move, double mm) { return 2 * move.limits.max_deceleration * move.mm_per_lead() * mm; }
double gains(const PathMove& move, double mm) { return 2 * move.limits.max_acceleration * move.mm_per_lead() * mm; }

/// Speeds (mm per tick) at the joints of moves[first, last): joints[0] before the first, all from rest to rest.
std::vector<double> joint_speeds(std::span<PathMove> moves, Displacement along, std::span<const AxisLimits> limits,
                                 const PathBounds& bounds) {
    const std::size_t n = moves.size();
    // One move alone from rest to rest jumps away from rest and back to it: changes that do not add up.
    std::vector<double> speed = n == 1 ? std::vector<double>(2, kUnbounded) : limit_corners(moves, along, limits);
    speed[0] = std::min({speed[0], moves[0].start_speed(), moves[0].top_speed()});
    speed[n] = std::min({speed[n], moves[n - 1].start_speed(), moves[n - 1].top_speed()});
    std::vector<double> brakes_before(n + 1, 0);  // the sum of what moves[0, i) can take away
    for (std::size_t i = 0; i < n; ++i) {
        brakes_before[i + 1] = brakes_before[i] + brakes(moves[i], moves[i].length_mm);
    }
    for (std::size_t i = 1; i < n; ++i) {
        const std::size_t horizon = std::min(n, i + bounds.stop_moves - 1);
        speed[i] = std::min({speed[i], moves[i - 1].top_speed(), moves[i].top_speed(),
                             std::sqrt(brakes_before[horizon] - brakes_before[i])});
    }
    for (std::size_t i = n - 1; i >= 1; --i) {
        speed[i] = std::min(speed[i], std::sqrt(speed[i + 1] * speed[i + 1] + brakes(moves[i], moves[i].length_mm)));
    }
    for (std::size_t i = 1; i <= n; ++i) {
        const double mm = i == 1 ? moves[0].remaining_mm(along) : moves[i - 1].length_mm;
        speed[i] = std::min(speed[i], std::sqrt(speed[i - 1] * speed[i - 1] + gains(moves[i - 1], mm)));
    }
    // A first move shorter than its start speed needs to brake: enter it more slowly.
    const double reach = speed[1] * speed[1] + brakes(moves[0], moves[0].remaining_mm(along));
    speed[0] = std::min(speed[0], std::sqrt(reach));
    return speed;
}

/// Profiles for moves that are joined at speed, from rest to rest.
void plan_joined(std::span<PathMove> moves, Displacement along, std::span<const AxisLimits> limits,
                 const PathBounds& bounds) {
    const std::vector<double> speed = joint_speeds(moves, along, limits, bounds);
    const std::int64_t quantum = moves.size() == 1 ? kSubticksPerTick : 1;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        PathMove& move = moves[i];
        const double scale = move.mm_per_lead();
        move.profile = plan_fastest({.from = i == 0 ? along : Displacement{},
                                     .to = Displacement::steps(move.lead),
                                     .entry = speed[i] / scale,
                                     .exit = speed[i + 1] / scale,
                                     .limits = move.limits,
                                     .quantum = quantum});
    }
}

/// What frames can carry of a move, and what a short rest before or behind it allows.
void limit_by_surroundings(std::vector<PathMove>& moves, std::size_t i, std::span<const AxisLimits> limits,
                           const PathBounds& bounds) {
    PathMove& move = moves[i];
    if (move.lead == 0) { return; }
    move.limits = move.own;
    if (i > 0 && moves[i - 1].lead == 0) { move.limits.start_velocity *= rest_share(moves[i - 1].dwell, limits); }
    if (i + 1 < moves.size() && moves[i + 1].lead == 0) {
        move.limits.start_velocity =
            std::min(move.limits.start_velocity, move.own.start_velocity * rest_share(moves[i + 1].dwell, limits));
    }
    const double fastest = static_cast<double>(move.lead) / static_cast<double>(bounds.least_move.value);
    move.limits.max_velocity = std::min(move.limits.max_velocity, fastest);
    move.limits.start_velocity = std::min(move.limits.start_velocity, move.limits.max_velocity);
}

/// What is left of a profile whose last phase is in progress, its time starting at 0.
Profile remainder_of(const Profile& profile, Subticks t) {
    const Phase& fall = profile.phases.back();
    const Subticks into = t - (profile.duration() - fall.duration);
    const auto entry = static_cast<std::int64_t>(std::llround(fall.velocity_at(into) * 0x1p48));
    Profile rest;
    (void)rest.phases.push_back({fall.at(into), fall.to, entry, fall.duration - into});
    return rest;
}

/// Whether the path comes to rest in the phase in progress at t, by braking or slowly enough to stop.
bool is_last_fall(const Path& path, std::size_t i, Subticks t) {
    const bool last_move = i + 1 == path.moves.size() || path.moves[i + 1].lead == 0;
    const PathMove& move = path.moves[i];
    return last_move && move.end() - t <= move.profile.phases.back().duration &&
           move.profile.phases.back().acceleration() < 0;
}

}  // namespace

PathBounds bounds_of(const MachineConfig& machine) {
    // Each move is three phases and the tick of its corner, in a tail one phase and that tick; and what the edges cut.
    constexpr std::int64_t kMovesPerFrame = kMaxBodyPieces / 4 - 4;
    constexpr std::size_t kMovesPerTail = kMaxTailPieces / 2 - 2;
    return {{machine.frame_ticks().value / kMovesPerFrame + 1}, kMovesPerTail};
}

PathMove make_move(const AxisCounts& from, const AxisCounts& to, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, double feed_mm_per_tick) {
    PathMove move{.from = from, .to = to, .feed_mm_per_tick = feed_mm_per_tick};
    double square = 0;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        move.lead = std::max(move.lead, std::abs(to[i] - from[i]));
        const double mm = static_cast<double>(to[i] - from[i]) / steps_per_mm[i];
        square += mm * mm;
    }
    if (move.lead == 0) { return move; }
    move.length_mm = std::sqrt(square);
    const double feed = feed_mm_per_tick > 0 ? feed_mm_per_tick / move.mm_per_lead() : kUnbounded;
    move.own = {kUnbounded, feed, kUnbounded, kUnbounded};
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double share = std::abs(move.share(i));
        if (share == 0) { continue; }
        move.own.start_velocity = std::min(move.own.start_velocity, limits[i].start_velocity / share);
        move.own.max_velocity = std::min(move.own.max_velocity, limits[i].max_velocity / share);
        move.own.max_acceleration = std::min(move.own.max_acceleration, limits[i].max_acceleration / share);
        move.own.max_deceleration = std::min(move.own.max_deceleration, limits[i].max_deceleration / share);
    }
    return move;
}

Path plan_path(std::vector<PathMove> moves, Displacement along, std::span<const AxisLimits> limits,
               const PathBounds& bounds) {
    Path path{std::move(moves)};
    for (std::size_t i = 0; i < path.moves.size(); ++i) { limit_by_surroundings(path.moves, i, limits, bounds); }
    Subticks clock;
    for (std::size_t first = 0; first < path.moves.size();) {
        std::size_t last = first;
        while (last < path.moves.size() && path.moves[last].lead != 0) { ++last; }
        if (last == first) {
            path.moves[first].profile = plan_dwell({}, path.moves[first].dwell);
            last = first + 1;
        } else {
            plan_joined(std::span(path.moves).subspan(first, last - first), first == 0 ? along : Displacement{}, limits,
                        bounds);
        }
        for (; first < last; ++first) {
            path.moves[first].start = clock;
            clock = path.moves[first].end();
        }
        clock = subticks(clock.ceil());
    }
    return path;
}

Path brake_from(const Path& path, Subticks t, std::span<const AxisLimits> limits) {
    Path rest;
    std::size_t i = path.move_at(t);
    if (t >= path.moves[i].end() || path.moves[i].lead == 0) { return rest; }
    if (is_last_fall(path, i, t)) {
        PathMove move = path.moves[i];
        move.profile = remainder_of(move.profile, t - move.start);
        move.start = {};
        rest.moves.push_back(move);
        return rest;
    }
    double speed = path.moves[i].profile.velocity_at(t - path.moves[i].start) * path.moves[i].mm_per_lead();
    Displacement from = path.moves[i].profile.at(t - path.moves[i].start);
    Subticks clock;
    for (; i < path.moves.size() && path.moves[i].lead != 0; ++i, from = {}) {
        PathMove move = path.moves[i];
        const Displacement whole = Displacement::steps(move.lead);
        if (from >= whole) { continue; }
        const double scale = move.mm_per_lead();
        const double planned = path.moves[i].profile.velocity_at({}) * scale;
        const bool is_slower = from == Displacement{} && speed <= planned;
        if (from == Displacement{}) { speed = std::min(speed, planned); }
        double braking = move.limits.max_deceleration;
        if (is_slower) { braking = std::max(braking, braking_left(path.moves, i, speed, limits)); }
        const double entry = speed / scale;
        if (entry <= 0) { break; }
        const double left = (whole - from).as_steps();
        const double at_end = entry * entry - 2 * braking * left;
        const bool halts = at_end <= 0;
        const double exit = halts ? 0 : std::sqrt(at_end);
        if (halts) { move.profile = plan_brake_to(from, entry, braking, clock); }
        if (!halts || move.profile.phases.back().to > whole) {
            move.profile = plan_brake_through(from, whole, entry, exit);
        }
        move.start = clock;
        clock = move.end();
        speed = exit * scale;
        rest.moves.push_back(move);
        if (halts) { break; }
    }
    return rest;
}

}  // namespace lockstep
