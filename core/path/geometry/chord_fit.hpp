// Finds the quadratic that follows a polyline best between two places, and checks whether it is close enough.
//
// With z(u) the polyline's place relative to the start, D the displacement to the end, L the length, and M1 and M2 the
// integrals of z u and z u^2, the square of the distance is least for
//
//     bend = [ (M2 - L M1) / 2 + D L^3 / 24 ] 120 / L^5
//
// With running sums of both integrals the cost of a bend is the same for every length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/path/axis_vector.hpp"
#include "core/path/geometry/primitive.hpp"
#include "core/path/geometry/quadratic.hpp"
#include "core/path/sliding_vector.hpp"

namespace lockstep {

/// A vertex of a programmed polyline.
struct PathPoint {
    PlaceVector at;           // steps
    double along = 0;         // mm from the polyline's start
    MoveSettings settings;    // of the chord that ends here
    std::uint32_t block = 0;  // of the program, of the chord that ends here
    double deflection = 0;    // 1 - cosine of the angle between the directions on either side
    bool is_corner = false;
    bool is_end = false;  // a piece ends here
};

class ChordFit {
public:
    /// Begins a piece at the place `from` (steps), which replaces the point with index `first`.
    void begin(std::size_t first, const PlaceVector& from);

    /// Fits a piece over `count` chords that ends at `to`. Returns false if it deviates from the polyline by more than
    /// `tolerance_steps` of an axis, at a vertex or the middle of a chord. `moving`: at least the axes that do not have
    /// the same place at all points.
    bool fit(const SlidingVector<PathPoint>& points, std::size_t count, const PlaceVector& to,
             std::span<const double> tolerance_steps, AxisSet moving, Quadratic& piece);

private:
    void extend(const SlidingVector<PathPoint>& points, std::size_t count);
    void bend(std::size_t count, Quadratic& piece) const;
    /// Whether the fitted piece deviates from the polyline by at most a share of the tolerance.
    bool is_close(const SlidingVector<PathPoint>& points, std::size_t count, std::span<const double> tolerance_steps,
                  double share, const Quadratic& piece) const;

    std::size_t first_ = 0;
    PlaceVector from_;
    AxisSet moving_;
    std::size_t summed_ = 0;    // chords in the sums
    std::vector<double> sums_;  // M1 and M2 of each axis up to each vertex; 0 before an axis moves
};

}  // namespace lockstep
