#include "core/motion/interpolate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

/// numerator / divisor, rounded to the nearest integer, halves away from 0.
Int128 divide_evenly(Int128 numerator, Int128 divisor) {
    const Int128 magnitude = ((numerator < 0 ? -numerator : numerator) + divisor / 2) / divisor;
    return numerator < 0 ? -magnitude : magnitude;
}

std::int64_t saturate(Int128 value) {
    constexpr Int128 kMost = std::numeric_limits<std::int64_t>::max();
    return static_cast<std::int64_t>(std::clamp(value, -kMost, kMost));
}

}  // namespace

Piece solve_piece(Position from, Position to, Ticks ticks, double acceleration) {
    const Int128 n = ticks.value;
    const auto a = static_cast<Int128>(std::llround(acceleration * 0x1p64));
    const Int128 v = divide_evenly((to - from).raw - n * (n + 1) / 2 * a, n);
    return {ticks, {saturate(v)}, {static_cast<std::int64_t>(a)}};
}

PieceSource::PieceSource(const Path& path, Ticks begin, Ticks end, std::span<Position> at)
    : path_(path), now_(begin), end_(end), at_(at) {}

/// Phases of one move meet at the nearest tick, because the speed is the same on both sides. At a move's end the speed
/// may jump. The tick of the jump is a separate stretch, otherwise the jump distorts the adjacent stretches.
Ticks PieceSource::stretch_end(const PathMove*& move, double& acceleration) const {
    constexpr Subticks kHalfTick{kSubticksPerTick / 2};
    move = &path_.moves[path_.move_at(subticks(now_))];
    const Subticks middle = subticks(now_) + kHalfTick;
    Subticks phase_end = move->start;
    for (const ProfilePhase& phase : move->profile.phases) {
        phase_end = phase_end + phase.duration;
        acceleration = phase.acceleration();
        if (middle < phase_end) { break; }
    }
    const Ticks corner = move->end().floor();
    const Ticks whole = phase_end >= move->end() ? corner : std::min((phase_end + kHalfTick).floor(), corner);
    return std::clamp(whole, now_ + Ticks{1}, end_);
}

bool PieceSource::next(std::span<Piece> pieces) {
    if (now_ >= end_) { return false; }
    const PathMove* move = nullptr;
    double acceleration = 0;
    const Ticks to = stretch_end(move, acceleration);
    const Ticks ticks = to - now_;
    if (ticks == Ticks{1}) { acceleration = 0; }  // one tick has one speed, even if a sloped phase ends in it
    if (subticks(to) > move->end() && move != &path_.moves.back()) { move = &path_.moves[path_.move_at(subticks(to))]; }
    const Displacement along = move->along_at(subticks(to));
    for (std::size_t i = 0; i < at_.size(); ++i) {
        const double share = move->lead == 0 ? 0 : move->share(i);
        pieces[i] = solve_piece(at_[i], move->axis_at(i, along), ticks, share * acceleration);
        at_[i] = at_[i] + pieces[i].covered();
    }
    now_ = to;
    return true;
}

Position start_of(const Path& path, std::size_t axis, std::int64_t count) {
    for (const PathMove& move : path.moves) {
        if (move.to[axis] != move.from[axis]) { return rest_position(count, move.to[axis] < move.from[axis]); }
    }
    return Position::steps(count);
}

std::vector<Piece> pieces_of(const Profile& profile, Position from, int direction) {
    std::vector<Piece> pieces;
    Position at = from;
    Subticks clock;
    Ticks done;
    for (const ProfilePhase& phase : profile.phases) {
        clock = clock + phase.duration;
        const bool last = &phase == profile.phases.end() - 1;
        const Ticks until = last ? clock.ceil() : clock.floor();
        if (until == done) { continue; }
        const Displacement gone = profile.at(subticks(until));
        const Position to = direction < 0 ? from - gone : from + gone;
        pieces.push_back(solve_piece(at, to, until - done, phase.acceleration() * direction));
        at = at + pieces.back().covered();
        done = until;
    }
    return pieces;
}

}  // namespace lockstep
