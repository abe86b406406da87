// One number for each axis of a machine, in the order of its configuration.
#pragma once

#include <bit>
#include <cmath>
#include <span>

#include "core/axis_set.hpp"
#include "core/static_vector.hpp"

namespace lockstep {

/// Places in fractional steps, or slopes in steps per mm of path.
using AxisVector = StaticVector<double, kMaxAxes>;

inline AxisVector zeros(std::size_t axes) {
    AxisVector v;
    for (std::size_t i = 0; i < axes; ++i) { v.append(0); }
    return v;
}

/// Calls visit(i) for each axis, or row, of a set, in ascending order.
template <typename Visit>
void each_of(AxisSet set, Visit visit) {
    for (; set != 0; set &= set - 1) { visit(static_cast<std::size_t>(std::countr_zero(set))); }
}

/// The distance of two places (in steps) in mm: the root of the sum of the axes' squares.
inline double distance_mm(const AxisVector& a, const AxisVector& b, std::span<const double> steps_per_mm) {
    double square = 0;
    for (std::size_t i = 0; i < steps_per_mm.size(); ++i) {
        const double mm = (b.begin()[i] - a.begin()[i]) / steps_per_mm[i];
        square += mm * mm;
    }
    return std::sqrt(square);
}

}  // namespace lockstep
