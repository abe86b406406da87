// One number for each axis of a machine, or for each row of a path.
#pragma once

#include <cmath>
#include <span>

#include "core/indices.hpp"
#include "core/static_vector.hpp"

namespace lockstep {

/// One number in this unit for each axis, or row. Numbers in different units are of different types.
template <typename Unit>
class UnitVector : public StaticVector<double, kMaxAxes> {
public:
    using StaticVector::StaticVector;
    static UnitVector zeros(std::size_t count) {
        UnitVector v;
        for (std::size_t i = 0; i < count; ++i) { v.append(0); }
        return v;
    }
};

/// Fractional steps.
using PlaceVector = UnitVector<struct InSteps>;
/// Steps per mm of path.
using SlopeVector = UnitVector<struct InStepsPerMm>;
/// Steps per mm^2 of path.
using BendVector = UnitVector<struct InStepsPerSquareMm>;

/// The distance of two places (in steps) in mm: the root of the sum of the axes' squares.
inline double distance_mm(const PlaceVector& a, const PlaceVector& b, std::span<const double> steps_per_mm) {
    double square = 0;
    for (std::size_t i = 0; i < steps_per_mm.size(); ++i) {
        const double mm = (b.begin()[i] - a.begin()[i]) / steps_per_mm[i];
        square += mm * mm;
    }
    return std::sqrt(square);
}

}  // namespace lockstep
