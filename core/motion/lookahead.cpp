#include "core/motion/lookahead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/motion/corners.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// How much of a squared speed the move can take away or add over a length: 2 a s.
double brakes(const PathMove& move, double mm) { return 2 * move.limits.max_deceleration * move.mm_per_lead() * mm; }
double gains(const PathMove& move, double mm) { return 2 * move.limits.max_acceleration * move.mm_per_lead() * mm; }

/// Speeds (mm per tick) at the joints of moves without rest between them: joints[0] before the first. Nothing where
/// they are entered so fast that they cannot be gone through.
std::optional<std::vector<double>> joint_speeds(std::span<PathMove> moves, const Entry& entry,
                                                std::span<const AxisLimits> limits, const PathBounds& bounds) {
    const std::size_t n = moves.size();
    // One move alone from rest to rest jumps away from rest and back to it: changes that do not add up.
    const bool alone = n == 1 && !entry.speed;
    std::vector<double> speed = alone ? std::vector<double>(2, kNoLimit) : limit_corners(moves, entry, limits);
    const double first_mm = moves[0].remaining_mm(entry.along);
    if (!entry.speed) { speed[0] = std::min({speed[0], moves[0].start_speed(), moves[0].top_speed()}); }
    speed[n] = std::min({speed[n], moves[n - 1].start_speed(), moves[n - 1].top_speed()});
    std::vector<double> brakes_before(n + 1, 0);  // the sum of what moves[0, i) can take away
    for (std::size_t i = 0; i < n; ++i) {
        brakes_before[i + 1] = brakes_before[i] + brakes(moves[i], i == 0 ? first_mm : moves[i].length_mm);
    }
    for (std::size_t i = 1; i < n; ++i) {
        const std::size_t horizon = std::min(n, i + bounds.stop_moves - 1);
        speed[i] = std::min(speed[i], std::sqrt(brakes_before[horizon] - brakes_before[i]));
    }
    for (std::size_t i = n - 1; i >= 1; --i) {
        speed[i] = std::min(speed[i], std::sqrt(speed[i + 1] * speed[i + 1] + brakes(moves[i], moves[i].length_mm)));
    }
    // A first move shorter than its start speed needs to brake: enter it more slowly.
    const double within_reach = std::sqrt(speed[1] * speed[1] + brakes(moves[0], first_mm));
    const double within_stop = std::sqrt(brakes_before[std::min(n, bounds.stop_moves)]);
    speed[0] = std::min(speed[0], within_reach);
    if (entry.speed) {
        constexpr double kRounding = 1e-9;
        if (std::min({speed[0], within_stop}) < *entry.speed * (1 - kRounding)) { return std::nullopt; }
        speed[0] = *entry.speed;
    }
    for (std::size_t i = 1; i <= n; ++i) {
        const double mm = i == 1 ? first_mm : moves[i - 1].length_mm;
        speed[i] = std::min(speed[i], std::sqrt(speed[i - 1] * speed[i - 1] + gains(moves[i - 1], mm)));
    }
    return speed;
}

/// Profiles for moves that are joined at speed, to rest; false where they are entered too fast.
bool plan_joined(std::span<PathMove> moves, const Entry& entry, std::span<const AxisLimits> limits,
                 const PathBounds& bounds) {
    const auto speed = joint_speeds(moves, entry, limits, bounds);
    if (!speed) { return false; }
    const std::int64_t quantum = moves.size() == 1 && !entry.speed ? kSubticksPerTick : 1;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        PathMove& move = moves[i];
        const double scale = move.mm_per_lead();
        move.profile = plan_fastest({.from = i == 0 ? entry.along : Displacement{},
                                     .to = Displacement::steps(move.lead),
                                     .entry = (*speed)[i] / scale,
                                     .exit = (*speed)[i + 1] / scale,
                                     .limits = move.limits,
                                     .quantum = quantum});
    }
    return true;
}

/// What feed and frames leave of a move's limits, and what a short rest before or behind it allows.
void limit_by_surroundings(std::span<PathMove> moves, std::size_t i, std::span<const AxisLimits> limits,
                           const PathBounds& bounds, const Overrides& overrides) {
    PathMove& move = moves[i];
    if (move.lead == 0) { return; }
    move.limits = move.own;
    if (i > 0 && moves[i - 1].lead == 0) { move.limits.start_velocity *= rest_share(moves[i - 1].dwell, limits); }
    if (i + 1 < moves.size() && moves[i + 1].lead == 0) {
        move.limits.start_velocity =
            std::min(move.limits.start_velocity, move.own.start_velocity * rest_share(moves[i + 1].dwell, limits));
    }
    const double fastest = static_cast<double>(move.lead) / static_cast<double>(bounds.least_move.value);
    move.limits.max_velocity = std::min(move.asked_velocity(overrides), fastest);
    move.limits.start_velocity = std::min(move.limits.start_velocity, move.limits.max_velocity);
}

/// Where a stretch without rest ends that begins with moves[first]: a dwell is a stretch of its own.
std::size_t stretch_end(std::span<const PathMove> moves, std::size_t first) {
    std::size_t last = first;
    while (last < moves.size() && moves[last].lead != 0) { ++last; }
    return std::max(last, first + 1);
}

/// Times for moves that have profiles, the first of which begins at `clock`; returns the time behind them.
Subticks set_times(std::span<PathMove> moves, Subticks clock) {
    for (PathMove& move : moves) {
        move.start = clock;
        move.gone = {};
        clock = move.end();
    }
    return subticks(clock.ceil());
}

/// Plans from moves[first] on, which begins at rest at `clock`.
void plan_from_rest(std::span<PathMove> moves, std::size_t first, Subticks clock, Displacement along,
                    std::span<const AxisLimits> limits, const PathBounds& bounds, const Overrides& overrides) {
    for (std::size_t i = first; i < moves.size(); ++i) { limit_by_surroundings(moves, i, limits, bounds, overrides); }
    while (first < moves.size()) {
        const auto stretch = moves.subspan(first, stretch_end(moves, first) - first);
        if (stretch.front().lead == 0) {
            stretch.front().profile = plan_dwell({}, stretch.front().dwell);
        } else {
            (void)plan_joined(stretch, {.along = along}, limits, bounds);  // from rest there is always a way
        }
        clock = set_times(stretch, clock);
        first += stretch.size();
        along = {};
    }
}

/// The speeds at the joints of moves that are planned already, if they are braked from `speed` on as hard as can be.
std::vector<double> braked_speeds(std::span<const PathMove> moves, Displacement along, double speed) {
    std::vector<double> speeds{speed};
    for (std::size_t i = 0; i < moves.size() && speed > 0; ++i) {
        const double mm = i == 0 ? moves[0].remaining_mm(along) : moves[i].length_mm;
        speed = std::sqrt(std::max(0.0, speed * speed - brakes(moves[i], mm)));
        speeds.push_back(speed);
    }
    return speeds;
}

/// What is left of a move's profile at t, as it was planned, its time starting at 0.
PathMove remainder_of(const PathMove& move, Subticks t) {
    PathMove rest = move;
    rest.start = rest.gone = {};
    rest.profile.phases.clear();
    Subticks into = t - move.start - move.gone;
    for (const Phase& phase : move.profile.phases) {
        if (into < phase.duration) {
            const auto entry = static_cast<std::int64_t>(std::llround(phase.velocity_at(into) * 0x1p48));
            rest.profile.phases.append({phase.at(into), phase.to, entry, phase.duration - into});
        }
        into = std::max(Subticks{}, into - phase.duration);
    }
    return rest;
}

/// A brake lasts whole subticks. What is left of the move at t may be so short that this would bend it by more than all
/// of the braking: it would speed up.
bool is_too_short_to_brake(const PathMove& move, Subticks t) {
    const double left = static_cast<double>((move.end() - t).value) / static_cast<double>(kSubticksPerTick);
    const double subtick = 1.0 / static_cast<double>(kSubticksPerTick);
    return move.limits.max_deceleration * left * left < 2 * move.velocity_at(t) * subtick;
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
    const std::int64_t moves_per_frame = body_pieces(machine.timing) / 4 - 4;
    constexpr std::size_t kMovesPerTail = kMaxTailPieces / 2 - 2;
    return {{machine.frame_ticks().value / moves_per_frame + 1}, kMovesPerTail, machine.frame_ticks()};
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

Path plan_path(std::vector<PathMove> moves, Displacement along, std::span<const AxisLimits> limits,
               const PathBounds& bounds, const Overrides& overrides) {
    Path path{std::move(moves)};
    plan_from_rest(path.moves, 0, {}, along, limits, bounds, overrides);
    return path;
}

bool replan_from(Path& path, Ticks t, std::span<const AxisLimits> limits, const PathBounds& bounds,
                 const Overrides& overrides) {
    const std::span<PathMove> moves = path.moves;
    if (t == Ticks{}) {
        plan_from_rest(moves, 0, {}, moves[0].along_at({}), limits, bounds, overrides);
        return true;
    }
    std::size_t first = path.move_at(subticks(t));
    Entry entry;
    Subticks clock = subticks(t);
    const PathMove& now = moves[first];
    if (now.lead != 0 && now.end() - clock >= subticks(bounds.worth_splitting)) {
        entry.along = now.along_at(clock);
        entry.speed = now.velocity_at(clock) * now.mm_per_lead();
    } else {
        clock = now.end();
        if (++first == moves.size()) { return true; }
        if (now.lead != 0 && moves[first].lead != 0) {
            entry.behind = &now;
            entry.speed = moves[first].profile.velocity_at({}) * moves[first].mm_per_lead();
        }
    }
    if (!entry.speed) {
        plan_from_rest(moves, first, moves[first].start, {}, limits, bounds, overrides);
        return true;
    }
    const std::size_t last = stretch_end(moves, first);
    const auto stretch = moves.subspan(first, last - first);
    entry.least = braked_speeds(stretch, entry.along, *entry.speed);
    std::vector<PathLimits> before;
    for (std::size_t i = first; i < last; ++i) {
        before.push_back(moves[i].limits);
        limit_by_surroundings(moves, i, limits, bounds, overrides);
    }
    if (!plan_joined(stretch, entry, limits, bounds)) {
        for (std::size_t i = first; i < last; ++i) { moves[i].limits = before[i - first]; }
        return false;
    }
    const Subticks begun = stretch.front().start;
    const Subticks behind = set_times(stretch, clock);
    if (entry.under_way()) {
        stretch.front().start = begun;
        stretch.front().gone = clock - begun;
    }
    plan_from_rest(moves, last, behind, {}, limits, bounds, overrides);
    return true;
}

Path brake_from(const Path& path, Subticks t, std::span<const AxisLimits> limits) {
    Path rest;
    std::size_t i = path.move_at(t);
    if (t >= path.moves[i].end() || path.moves[i].lead == 0) { return rest; }
    double speed = path.moves[i].velocity_at(t) * path.moves[i].mm_per_lead();
    Displacement from = path.moves[i].along_at(t);
    Subticks clock;
    const bool is_falling = is_last_fall(path, i, t);
    if (is_falling || is_too_short_to_brake(path.moves[i], t)) {
        const PathMove& move = rest.moves.emplace_back(remainder_of(path.moves[i], t));
        if (is_falling) { return rest; }
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
        move.gone = {};
        clock = move.end();
        speed = exit * scale;
        rest.moves.push_back(move);
        if (halts) { break; }
    }
    return rest;
}

}  // namespace lockstep
