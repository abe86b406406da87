#include "core/path/geometry/arc_cutter.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/travel_end.hpp"

namespace lockstep {
namespace {

constexpr double kLeastRadius_steps = 0.25;

}  // namespace

bool ArcCutter::begin(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
                      std::uint32_t block) {
    const ArcSpoke begin = arc_spoke(setup, arc, ends.from);
    const ArcSpoke end = arc_spoke(setup, arc, ends.to);
    const double greatest = std::max(begin.radius_mm, end.radius_mm);
    at_ = ends.at;
    settings_ = settings;
    block_ = block;
    along_ = 0;
    sweep_ = {};
    if (!(std::min(begin.radius_mm, end.radius_mm) > 0)) { return false; }
    if (greatest <= kLeastRadius_steps / steps_per_mm_of_plane(setup, arc)) { return false; }
    sweep_ = ArcSweep(begin.direction, end.direction, arc.turns);
    curve_ = ArcCurve(setup, arc, ends, begin.radius_mm, end.radius_mm, sweep_.angle());
    return true;
}

void ArcCutter::cut_on(const PathSetup& setup, PathTrail& out) {
    if (!is_done()) { halve(setup, sweep_.take(), out); }
}

void ArcCutter::skip(const PathSetup& setup, int turns) {
    const ArcPart behind = sweep_.skip(turns);
    curve_.place(setup, behind.a, behind.done, at_);
}

/// Halves the part while it is too long for one piece.
void ArcCutter::halve(const PathSetup& setup, const ArcPart& part, PathTrail& out) {
    const double angle = part.angle;
    const double half = part.done + angle / 2;
    const ArcDirection middle = between(part.a, part.b);
    if (!curve_.is_near(part.done, angle)) {
        halve(setup, {part.a, middle, part.done, angle / 2, false}, out);
        halve(setup, {middle, part.b, half, angle / 2, part.is_last}, out);
        return;
    }
    PlaceVector half_way = at_;
    curve_.place(setup, middle, half, half_way);
    if (part.is_last) { return add_piece(setup, half_way, curve_.end(), out); }
    PlaceVector end = at_;
    curve_.place(setup, part.b, part.done + angle, end);
    add_piece(setup, half_way, end, out);
}

/// The distance of two places on the arc.
double ArcCutter::distance(const PathSetup& setup, const PlaceVector& a, const PlaceVector& b) const {
    double square = 0;
    for (const AxisIndex i : curve_.moving()) {
        const double mm = (b.begin()[i] - a.begin()[i]) / setup.steps_per_mm[i];
        square += mm * mm;
    }
    return std::sqrt(square);
}

/// The length is the chord's plus the excess of the arc: 8/3 of the square of its height, divided by the chord.
void ArcCutter::add_piece(const PathSetup& setup, const PlaceVector& middle, const PlaceVector& end, PathTrail& out) {
    Quadratic piece;
    piece.feed_mm_per_tick = settings_.feed_mm_per_tick;
    piece.is_feed_fixed = settings_.is_feed_fixed;
    piece.most_mm_per_tick = settings_.most_mm_per_tick;
    piece.from = at_;
    piece.slope = SlopeVector::zeros(at_.size());
    piece.bend = BendVector::zeros(at_.size());
    const double chord = distance(setup, at_, end);
    PlaceVector& half_way = at_;
    for (const AxisIndex i : curve_.moving()) { half_way.begin()[i] = (piece.from.begin()[i] + end.begin()[i]) / 2; }
    const double height = distance(setup, half_way, middle);
    piece.length = chord + 8 * height * height / (3 * chord);
    for (const AxisIndex i : curve_.moving()) {
        piece.slope.begin()[i] = (end.begin()[i] - piece.from.begin()[i]) / piece.length;
        piece.bend.begin()[i] = -8 * (middle.begin()[i] - half_way.begin()[i]) / (piece.length * piece.length);
    }
    piece.is_straight = false;
    keep_within_travel(setup, piece);
    at_ = end;
    out.mark(0, block_, along_);
    out.add(piece);
    along_ += piece.length;
}

bool cut_arc(const PathSetup& setup, const ArcShape& arc, const ArcEnds& ends, const MoveSettings& settings,
             std::uint32_t block, PathTrail& out) {
    ArcCutter cutter;
    if (!cutter.begin(setup, arc, ends, settings, block)) { return false; }
    while (!cutter.is_done()) { cutter.cut_on(setup, out); }
    return true;
}

}  // namespace lockstep
