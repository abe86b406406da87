// A piece of geometry: each axis, or row of PathSetup, is a quadratic function of the distance u along the piece.
//
//     x(u) = from + slope u + bend u (u - length) / 2,   0 <= u <= length
//
// so x(length) = from + slope length exactly, for any bend. u counts mm of path (|dx/du| is 1 mm per mm up to the
// square of a small angle).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/path/axis_vector.hpp"
#include "core/units.hpp"

namespace lockstep {

struct Quadratic {
    PlaceVector from;
    SlopeVector slope;                       // of the chord
    BendVector bend;                         // curvature times scale
    double length = 0;                       // mm; 0: a rest
    std::optional<double> feed_mm_per_tick;  // nullopt: as fast as the axes allow
    bool is_feed_fixed = false;              // the feed override has no effect
    double most_mm_per_tick = std::numeric_limits<double>::infinity();
    bool is_straight = true;      // bend is 0
    bool begins_at_rest = false;  // the machine rests at its begin, and there at whole steps
    bool ends_at_rest = false;
    bool is_aside = false;     // the place on the geometry stays at its begin while motors move beside it
    std::uint32_t chords = 1;  // moves that were joined to it
    Ticks rest;                // duration if length is 0
    std::size_t piece = 0;     // the number of the piece of geometry in its stream
    double begin = 0;  // mm: rows may have several pieces for one piece of geometry, and this is where one begins
    RowSet moving;     // those with a slope or a bend, as moving_rows() has found them

    /// The place on the geometry changes.
    bool moves_on() const { return length > 0 && !is_aside; }
    double place(std::size_t i, double u) const {
        return from.begin()[i] + (slope.begin()[i] + bend.begin()[i] * (u - length) / 2) * u;
    }
    double slope_at(std::size_t i, double u) const { return slope.begin()[i] + bend.begin()[i] * (u - length / 2); }
};

inline RowSet moving_rows(const Quadratic& piece) {
    RowSet moving;
    for (const RowIndex i : row_indices(piece.slope.size())) {
        if (piece.slope.begin()[i] != 0 || piece.bend.begin()[i] != 0) { moving.insert(i); }
    }
    return moving;
}

}  // namespace lockstep
