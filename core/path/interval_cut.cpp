#include "core/path/interval_cut.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kMost = PieceJoints::kMost;
constexpr std::size_t kLeastParts = 4;  // of a piece that may be faster than the joints at its ends
constexpr double kChordsInPart = 16;  // of a part, if outputs change along the path: a tail may pass through all of it

/// The angle by which the piece's direction changes over `length`, rad.
double direction_change(const Quadratic& piece, double length, const PathSetup& setup) {
    double square = 0;
    for (const RowIndex i : RowSet::of_bits(piece.moving.bits() >> setup.first_axis_row())) {
        const double bend = piece.bend.begin()[setup.first_axis_row() + i] / setup.steps_per_mm[i];
        square += bend * bend;
    }
    return std::sqrt(square) * length;
}

}  // namespace

IntervalKind IntervalCut::kind_of(const JoinedPiece& piece) {
    if (piece.shape.length == 0) { return IntervalKind::Rest; }
    return piece.shape.is_straight && !piece.is_charged ? IntervalKind::Straight : IntervalKind::Curved;
}

/// The piece as one interval.
Interval IntervalCut::whole(const JoinedPiece& piece, const Neighbours& beside) const {
    Interval whole{.kind = kind_of(piece), .from = beside.from, .to = piece.shape.length, .joint = kMost};
    if (whole.kind != IntervalKind::Straight) { return whole; }
    whole.acceleration = whole.deceleration = kMost;
    for (const RowIndex i : piece.shape.moving) {
        const double slope = std::abs(piece.shape.slope.begin()[i]);
        if (slope <= kNothing) { continue; }
        whole.acceleration = std::min(whole.acceleration, setup_.limits[i].max_acceleration / slope);
        whole.deceleration = std::min(whole.deceleration, setup_.limits[i].max_deceleration / slope);
    }
    return whole;
}

/// A piece that may be faster than both of its ends has at least kLeastParts.
std::size_t IntervalCut::parts_of(const JoinedPiece& piece, const Neighbours& beside, IntervalBounds& whole) const {
    const double length = piece.shape.length - beside.from;
    const double by_length = length / kMaxInterval_mm;
    const double by_direction = direction_change(piece.shape, length, setup_) / kMaxDirectionChange;
    const double by_chords = setup_.has_outputs ? piece.shape.chords / kChordsInPart : 0;
    const std::size_t parts = 1 + static_cast<std::size_t>(std::max({by_length, by_direction, by_chords}));
    if (parts >= kLeastParts || piece.shape.is_straight) { return std::max(parts, kLeastParts); }
    const double top = whole.cap(overrides_);
    const bool is_slow_at_ends = beside.begin.cap < top && std::min(beside.end.cap, piece.end_cap) < top;
    return is_slow_at_ends ? kLeastParts : parts;
}

/// The fields that differ are set in place: to copy a value whose parts have just been written is slow.
void IntervalCut::cut(const JoinedPiece& piece, std::size_t number, const Neighbours& beside,
                      SlidingVector<Interval>& intervals) const {
    Interval whole = this->whole(piece, beside);
    whole.piece = number;
    IntervalBounds bounds(setup_, piece, whole);
    const std::size_t parts = whole.kind == IntervalKind::Curved ? parts_of(piece, beside, bounds) : 1;
    std::optional<double> common;
    if (whole.kind == IntervalKind::Rest) { common = kMost; }
    if (parts > 1) { common = bounds.common_cap(overrides_); }
    double cap = intervals.empty() ? beside.begin.cap : std::min(beside.begin.cap, intervals.back().top);
    const std::size_t first = intervals.size();
    for (std::size_t k = 0; k < parts; ++k) {
        intervals.push_back(whole);
        Interval& part = intervals.back();
        if (k > 0) { part.from = intervals[intervals.size() - 2].to; }
        if (k + 1 < parts) {
            part.to = beside.from + whole.length() * static_cast<double>(k + 1) / static_cast<double>(parts);
        }
        bounds.take(piece, part);
        part.top = common ? *common : bounds.cap(overrides_);
        part.cap = std::min(cap, part.top);
        cap = part.top;
    }
    intervals[first].jump = beside.begin.jump;
    intervals[first].joint = beside.begin.cap;
}

}  // namespace lockstep
