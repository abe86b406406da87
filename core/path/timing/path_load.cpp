#include "core/path/timing/path_load.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep {
namespace {

void raise(double& peak, double value) { peak = std::max(peak, value); }

/// The whole step nearest to a place of less than 2^52 steps, without a call of std::floor.
std::int64_t nearest_count(double place) {
    const double above = place + 0.5;
    const auto count = static_cast<std::int64_t>(above);
    return count - (above < static_cast<double>(count) ? 1 : 0);
}

}  // namespace

PathLoad::PathLoad(std::span<const std::int64_t> at) : counts_(at.begin(), at.end()), slopes_(at.size()) {
    for (const std::int64_t count : at) { axes_.push_back({.least = count, .greatest = count}); }
}

void PathLoad::begin() { std::ranges::fill(slopes_, 0.0); }

void PathLoad::note_place(RowIndex row, double place) {
    const std::int64_t count = nearest_count(place);
    AxisLoad& load = axes_[row];
    load.steps += std::abs(count - counts_[row]);
    load.least = std::min(load.least, count);
    load.greatest = std::max(load.greatest, count);
    counts_[row] = count;
}

/// Notes the place where each axis turns back, if it does, and the end.
void PathLoad::note_piece(const Quadratic& shape) {
    for (const RowIndex i : shape.moving& RowSet::first(axes_.size())) {
        const double bend = shape.bend.begin()[i];
        const double slope = shape.slope.begin()[i];
        if (std::abs(bend) * shape.length > 2 * std::abs(slope)) {
            note_place(i, shape.place(i, shape.length / 2 - slope / bend));
        }
        note_place(i, shape.place(i, shape.length));
    }
}

/// Notes the jumps where the next piece begins.
void PathLoad::note_joint(const JoinedPiece& next, double v) {
    const Quadratic& shape = next.shape;
    const bool is_rest = shape.length == 0;
    for (const RowIndex i : next.rows& RowSet::first(axes_.size())) {
        note_jump(i, is_rest ? 0 : shape.slope_at(i, 0), v);
        slopes_[i] = is_rest ? 0 : shape.slope_at(i, shape.length);
    }
}

void PathLoad::note_jump(RowIndex row, double slope, double v) {
    raise(axes_[row].peak_jump, std::abs(slope - slopes_[row]) * v);
}

void PathLoad::pass(const PassedInterval& passed, bool is_first) {
    if (is_first) {
        note_joint(passed.piece, passed.v0);
        note_piece(passed.piece.shape);
    }
    if (passed.part.kind == IntervalKind::Straight) { note_straight(passed); }
    if (passed.part.kind == IntervalKind::Curved) { note_curved(passed); }
}

void PathLoad::note_straight(const PassedInterval& passed) {
    const double up = passed.top > passed.v0 ? passed.part.acceleration : 0;
    const double change = passed.top > passed.v1 ? std::max(up, passed.part.deceleration) : up;
    for (const RowIndex i : passed.piece.shape.moving& RowSet::first(axes_.size())) {
        const double slope = std::abs(passed.piece.shape.slope.begin()[i]);
        raise(axes_[i].peak_velocity, slope * passed.top);
        raise(axes_[i].peak_acceleration, slope * change);
    }
}

/// The accelerations at both ends of the interval, and at its middle with the bend that the joints charge
/// (core/path/interval.hpp has the formulas, with w1 - w0 as `change` here).
void PathLoad::note_curved(const PassedInterval& passed) {
    const double d = passed.part.length();
    if (d <= 0) { return; }
    const double middle = (passed.part.from + passed.part.to) / 2;
    const double w0 = passed.v0 * passed.v0;
    const double w1 = passed.v1 * passed.v1;
    const double change = w1 - w0;
    const double half_per_mm = 1 / (2 * d);
    for (const RowIndex i : passed.piece.rows& RowSet::first(axes_.size())) {
        const double slope = passed.piece.shape.slope_at(i, middle);
        const double bend = passed.piece.shape.bend.begin()[i] * d;
        const double begin = slope - bend / 2;
        const double end = slope + bend / 2;
        double most = std::max(std::abs(change * begin + 2 * w0 * bend), std::abs(change * end + 2 * w1 * bend));
        if (passed.piece.is_charged) {
            const double charged = passed.piece.charged.begin()[i] * d;
            raise(most, std::abs(change * slope + (w0 + w1) * charged));
        }
        AxisLoad& load = axes_.data()[i];
        raise(load.peak_velocity, std::max(std::abs(begin) * passed.v0, std::abs(end) * passed.v1));
        raise(load.peak_acceleration, most * half_per_mm);
    }
}

void PathLoad::end(double v) {
    for (const RowIndex i : row_indices(axes_.size())) { note_jump(i, 0, v); }
}

}  // namespace lockstep
