#include "core/path/geometry/chord_fit.hpp"

#include <cmath>

namespace lockstep {
namespace {

constexpr double kStraightShare = 0.5;  // of the tolerance: a line within it is preferred to a curve

}  // namespace

void ChordFit::begin(std::size_t first, const PlaceVector& from) {
    first_ = first;
    from_ = from;
    summed_ = 0;
    sums_.assign(2 * from.size(), 0);
}

/// Simpson's rule is exact: z is linear in each chord, so z u^2 is cubic.
void ChordFit::extend(const SlidingVector<PathPoint>& points, std::size_t count) {
    const std::size_t axes = from_.size();
    for (; summed_ < count; ++summed_) {
        const PathPoint& a = points[first_ + summed_];
        const PathPoint& b = points[first_ + summed_ + 1];
        const double u0 = a.along - points[first_].along;
        const double u1 = b.along - points[first_].along;
        const double um = (u0 + u1) / 2;
        const double sixth = (u1 - u0) / 6;
        const std::size_t last = sums_.size() - 2 * axes;
        sums_.resize(sums_.size() + 2 * axes);
        for (const AxisIndex i : moving_) {
            const double z0 = a.at.begin()[i] - from_.begin()[i];
            const double z1 = b.at.begin()[i] - from_.begin()[i];
            const double zm = 2 * (z0 + z1) * um;
            const std::size_t before = last + 2 * i;
            const std::size_t here = before + 2 * axes;
            sums_[here] = sums_[before] + sixth * (z0 * u0 + zm + z1 * u1);
            sums_[here + 1] = sums_[before + 1] + sixth * (z0 * u0 * u0 + zm * um + z1 * u1 * u1);
        }
    }
}

void ChordFit::bend(std::size_t count, Quadratic& piece) const {
    const std::size_t axes = from_.size();
    const double length = piece.length;
    const double square = length * length;
    for (const AxisIndex i : moving_) {
        const double m1 = sums_[2 * (count * axes + i)];
        const double m2 = sums_[2 * (count * axes + i) + 1];
        const double way = piece.slope[i] * length;
        piece.bend[i] = ((m2 - length * m1) / 2 + way * square * length / 24) * 120 / (square * square * length);
    }
    piece.is_straight = false;
}

bool ChordFit::is_close(const SlidingVector<PathPoint>& points, std::size_t count,
                        std::span<const double> tolerance_steps, double share, const Quadratic& piece) const {
    for (const AxisIndex i : moving_) {
        const double most = share * tolerance_steps[i];
        double before = points[first_].at.begin()[i];
        double u0 = 0;
        for (std::size_t k = 1; k <= count; ++k) {
            const PathPoint& point = points[first_ + k];
            const double at = point.at.begin()[i];
            const double u1 = point.along - points[first_].along;
            const double vertex = piece.place(i, u1) - at;
            const double middle = piece.place(i, (u0 + u1) / 2) - (before + at) / 2;
            if (std::abs(vertex) > most || std::abs(middle) > most) { return false; }
            before = at;
            u0 = u1;
        }
    }
    return true;
}

bool ChordFit::fit(const SlidingVector<PathPoint>& points, std::size_t count, const PlaceVector& to,
                   std::span<const double> tolerance_steps, AxisSet moving, Quadratic& piece) {
    moving_ = moving;
    piece.from = from_;
    piece.length = points[first_ + count].along - points[first_].along;
    piece.slope = SlopeVector::zeros(from_.size());
    piece.bend = BendVector::zeros(from_.size());
    for (const AxisIndex i : moving_) { piece.slope.begin()[i] = (to.begin()[i] - from_.begin()[i]) / piece.length; }
    piece.is_straight = true;
    if (count == 1) { return true; }
    if (is_close(points, count, tolerance_steps, kStraightShare, piece)) { return true; }
    extend(points, count);
    bend(count, piece);
    return is_close(points, count, tolerance_steps, 1, piece);
}

}  // namespace lockstep
