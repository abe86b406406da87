#include "core/path/piece_joints.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kStopShare = 0.8;   // of the start velocity, where the path begins or ends: a joint may follow
constexpr double kRestShare = 0.4;   // of the start velocity, at a short rest or a piece aside: two jumps follow
constexpr double kWorthSlowing = 2;  // least gain, because the adjacent pieces become slower too
constexpr int kMostHalves = 40;

}  // namespace

Joint PieceJoints::joint(const Quadratic* before, const Quadratic* after, double from) const {
    Joint joint{kMost, 0};
    const bool is_stop = before == nullptr || after == nullptr;
    const bool is_rest = (before != nullptr && before->length == 0) || (after != nullptr && after->length == 0);
    const bool is_aside = (before != nullptr && before->is_aside) || (after != nullptr && after->is_aside);
    for (const RowIndex i : Neighbours{before, after}.moving()) {
        const double t0 = before == nullptr || before->length == 0 ? 0 : before->slope_at(i, before->length);
        const double t1 = after == nullptr || after->length == 0 ? 0 : after->slope_at(i, before == nullptr ? from : 0);
        const double jump = std::abs(t1 - t0);
        if (jump < kNothing) { continue; }
        const double start = setup_.limits[i].start_velocity;
        const bool is_followed = is_aside || (is_rest && !is_stop);
        const double share = is_followed ? kRestShare : is_stop ? kStopShare : kJointShare;
        const double speed = share * start / jump;
        joint.cap = std::min(joint.cap, speed * speed);
        joint.jump = std::max(joint.jump, jump / start);
    }
    return joint;
}

/// The passage of a piece at the greatest speed by limits and joints. It tells which jumps a straight piece can
/// recover.
struct PieceJoints::FastPassage {
    double v0 = 0;  // mm per tick
    double v1 = 0;
    double rise = 0;  // ticks
    double cruise = 0;
    double fall = 0;
    double acceleration = 0;  // mm per tick^2

    FastPassage(double w0, double w1, double top, double a, const Interval& whole) : acceleration(a) {
        const double length = whole.length();
        const double most_change = 2 * a * length;
        w0 = std::min(w0, w1 + most_change);
        w1 = std::min(w1, w0 + most_change);
        v0 = std::sqrt(w0);
        v1 = std::sqrt(w1);
        if (whole.kind != IntervalKind::Straight) { return; }
        const double peak = std::sqrt(std::max({std::min((w0 + w1) / 2 + a * length, top), w0, w1}));
        rise = (peak - v0) / a;
        fall = std::max(peak - v1, 0.0) / a;
        cruise = std::max(0.0, length - (v0 + peak) / 2 * rise - (v1 + peak) / 2 * fall) / peak;
    }

    double ticks() const { return rise + cruise + fall; }

    /// The jumps up (or down), in steps per tick, from which an axis of this slope and acceleration limit recovers.
    double recovers(double slope, double limit, bool is_up) const {
        const double along = (is_up ? slope : -slope) * acceleration;
        return (limit - along) * rise + limit * cruise + (limit + along) * fall;
    }
};

PieceJoints::FastPassage PieceJoints::fast_passage(const JoinedPiece& piece, const Neighbours& beside) const {
    const Quadratic& shape = piece.shape;
    const double from = beside.from;
    const IntervalKind kind = shape.is_straight ? IntervalKind::Straight : IntervalKind::Curved;
    const Interval whole{.kind = kind, .from = from, .to = shape.length};
    const double top = IntervalBounds(setup_, piece, whole).cap(overrides_);
    double path_acceleration = kMost;
    for (const RowIndex i : shape.moving) {
        const double slope = std::abs(shape.slope.begin()[i]);
        if (slope > kNothing) { path_acceleration = std::min(path_acceleration, weaker(setup_.limits[i]) / slope); }
    }
    const double w0 = std::min({beside.begin.cap, top, piece.begin_cap});
    const double w1 = std::min({beside.end.cap, top, piece.end_cap});
    return {w0, w1, top, path_acceleration, whole};
}

void PieceJoints::settle(JoinedPiece& piece, const Neighbours& beside) const {
    if (piece.shape.moves_on()) { charge(piece, beside); }
    if (piece.is_charged && piece.shape.is_straight) { slow(piece, beside); }
}

/// Jumps from and to rest are not counted here. Each piece recovers half of the other jumps at its ends, so that jumps
/// never add up to more than one. If the piece is too short for that on an axis, the jumps at its ends are charged as
/// bend of this axis, spread over the piece.
void PieceJoints::charge(JoinedPiece& piece, const Neighbours& beside) const {
    const Quadratic* const before = beside.before;
    const Quadratic* const next = beside.next;
    const Quadratic& shape = piece.shape;
    const FastPassage fast = fast_passage(piece, beside);
    const double length = shape.length - beside.from;
    const bool follows = beside.follows();
    const bool goes_on = beside.goes_on();
    piece.is_charged = false;
    for (const RowIndex i : piece.rows) {
        const double jump0 = follows ? shape.slope_at(i, 0) - before->slope_at(i, before->length) : 0;
        const double jump1 = goes_on ? next->slope_at(i, 0) - shape.slope_at(i, shape.length) : 0;
        const double jumps = (jump0 * fast.v0 + jump1 * fast.v1) / 2;
        const double recovered =
            shape.is_straight ? fast.recovers(shape.slope[i], weaker(setup_.limits[i]), jumps > 0) : 0;
        if (std::abs(jumps) <= recovered) { continue; }
        if (!piece.is_charged) { piece.charged = shape.bend; }
        piece.is_charged = true;
        piece.charged[i] += (jump0 + jump1) / (2 * length);
    }
}

/// Slows the joints in place of the charge, if that takes less time. This is so for a long piece with a joint from
/// which one axis recovers slowly: the charge would slow the whole piece.
void PieceJoints::slow(JoinedPiece& piece, const Neighbours& beside) const {
    const double from = beside.from;
    const Interval whole{.kind = IntervalKind::Curved, .from = from, .to = piece.shape.length};
    const double charged_ticks = whole.length() / std::sqrt(IntervalBounds(setup_, piece, whole).cap(overrides_));
    const FastPassage fast = fast_passage(piece, beside);
    JoinedPiece slowed;
    slowed.shape = piece.shape;
    slowed.rows = piece.rows;
    double share = 1;
    for (int halves = 0; halves < kMostHalves; ++halves) {
        share /= 2;
        if (beside.follows()) { slowed.begin_cap = share * fast.v0 * fast.v0; }
        if (beside.goes_on()) { slowed.end_cap = share * fast.v1 * fast.v1; }
        charge(slowed, beside);
        if (slowed.is_charged) { continue; }
        if (kWorthSlowing * fast_passage(slowed, beside).ticks() < charged_ticks) { piece = slowed; }
        return;
    }
}

}  // namespace lockstep
