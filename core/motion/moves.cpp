#include "core/motion/moves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// The rest of a move from t on, as planned, with its time starting at 0.
PathMove remainder_of(const PathMove& move, Subticks t) {
    PathMove rest = move;
    rest.start = {};
    rest.profile.phases.clear();
    Subticks into = t - move.start;
    for (const ProfilePhase& phase : move.profile.phases) {
        if (into < phase.duration) {
            const auto entry = static_cast<std::int64_t>(std::llround(phase.velocity_at(into) * 0x1p48));
            rest.profile.phases.append({phase.at(into), phase.to, entry, phase.duration - into});
        }
        into = std::max(Subticks{}, into - phase.duration);
    }
    return rest;
}

/// The time of braking is rounded to whole subticks. If the move has very little time left at t, the rounding changes
/// its speed by more than the braking does, and it would speed up.
bool is_too_short_to_brake(const PathMove& move, Subticks t) {
    const double left = static_cast<double>((move.end() - t).value) / static_cast<double>(kSubticksPerTick);
    const double subtick = 1.0 / static_cast<double>(kSubticksPerTick);
    return move.limits.max_deceleration * left * left < 2 * move.velocity_at(t) * subtick;
}

/// Whether the phase in progress at t is the path's last deceleration, after which it rests.
bool is_last_fall(const Path& path, std::size_t i, Subticks t) {
    const bool last_move = i + 1 == path.moves.size() || path.moves[i + 1].lead == 0;
    const PathMove& move = path.moves[i];
    return last_move && move.end() - t <= move.profile.phases.back().duration &&
           move.profile.phases.back().acceleration() < 0;
}

/// The change of axis i's slope between two moves, in steps per mm. A null move is rest.
double slope_change(const PathMove* before, const PathMove* after, std::size_t i) {
    return std::abs((after != nullptr ? after->slope(i) : 0) - (before != nullptr ? before->slope(i) : 0));
}

/// The deceleration (lead steps per tick^2) that the corners of move `m` leave for braking, if its speed is `speed` (mm
/// per tick) or less from its entry on. Jumps in slower corners are smaller. An axis with the jumps J1 and J2 at the
/// ends of a move of duration T has a - (J1 + J2) / 2T of its acceleration a left.
double braking_left(std::span<const PathMove> moves, std::size_t m, double speed, std::span<const AxisLimits> limits) {
    double left = kNoLimit;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double share = std::abs(moves[m].share(i));
        if (share == 0) { continue; }
        const PathMove* before = m == 0 ? nullptr : &moves[m - 1];
        const PathMove* after = m + 1 == moves.size() ? nullptr : &moves[m + 1];
        const double jump = (slope_change(before, &moves[m], i) + slope_change(&moves[m], after, i)) / 2 * speed;
        left = std::min(left, (limits[i].max_deceleration - jump * speed / moves[m].length_mm) / share);
    }
    return left;
}

}  // namespace

Ticks least_move(const MachineConfig& machine) {
    // A move has four pieces: three phases and the tick of its corner. Four moves are reserved for the frame's edges.
    const std::int64_t moves_per_frame = std::max(body_pieces(machine.timing) / 4 - 4, 1);
    return {machine.frame_ticks().value / moves_per_frame + 1};
}

PathMove make_move(const AxisCounts& from, const AxisCounts& to, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, std::optional<double> feed_mm_per_tick) {
    PathMove move{.from = from, .to = to, .feed_mm_per_tick = feed_mm_per_tick};
    double square = 0;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        move.lead = std::max(move.lead, std::abs(to[i] - from[i]));
        const double mm = static_cast<double>(to[i] - from[i]) / steps_per_mm[i];
        square += mm * mm;
    }
    if (move.lead == 0) { return move; }
    move.length_mm = std::sqrt(square);
    move.own = {kNoLimit, kNoLimit, kNoLimit, kNoLimit};
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

PathMove plan_alone(PathMove move, Displacement along, Ticks least) {
    if (move.lead == 0) {
        move.profile = plan_dwell({}, move.dwell);
        return move;
    }
    move.limits = move.own;
    const double fastest = static_cast<double>(move.lead) / static_cast<double>(least.value);
    move.limits.max_velocity = std::min(move.asked_velocity(), fastest);
    move.limits.start_velocity = std::min(move.limits.start_velocity, move.limits.max_velocity);
    const double scale = move.mm_per_lead();
    const double speed = std::min(move.start_speed(), move.top_speed()) / scale;
    move.profile = plan_fastest({.from = along,
                                 .to = Displacement::steps(move.lead),
                                 .entry = speed,
                                 .exit = speed,
                                 .limits = move.limits,
                                 .quantum = kSubticksPerTick});
    return move;
}

void brake_from(const Path& path, Subticks t, std::span<const AxisLimits> limits, Path& rest) {
    rest.moves.clear();
    std::size_t i = path.move_at(t);
    if (t >= path.moves[i].end() || path.moves[i].lead == 0) { return; }
    double speed = path.moves[i].velocity_at(t) * path.moves[i].mm_per_lead();
    Displacement from = path.moves[i].along_at(t);
    Subticks clock;
    const bool is_falling = is_last_fall(path, i, t);
    if (is_falling || is_too_short_to_brake(path.moves[i], t)) {
        const PathMove& move = rest.moves.emplace_back(remainder_of(path.moves[i], t));
        if (is_falling) { return; }
        clock = move.end();
        speed = move.velocity_at(clock) * move.mm_per_lead();
        from = {};
        ++i;
    }
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
}

}  // namespace lockstep
