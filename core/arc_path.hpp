// An arc, helix or spiral between two places: its length, its extent and its chords. Travel checks, estimates and
// pictures use it. The planner cuts arcs with core/path/geometry/arc_cutter.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

/// The distances of an arc's ends from its centre, in mm.
struct ArcRadii {
    double begin;
    double end;

    ArcRadii(const ArcShape& shape, std::span<const double> from_mm, std::span<const double> to_mm)
        : begin(of(shape, from_mm)), end(of(shape, to_mm)) {}
    double greatest() const { return std::max(begin, end); }

private:
    static double of(const ArcShape& shape, std::span<const double> at_mm) {
        return std::hypot(at_mm[shape.first] - shape.centre_first_mm, at_mm[shape.second] - shape.centre_second_mm);
    }
};

class ArcPath {
public:
    /// `from_mm` and `to_mm` have one place per axis; the shape's axes are indices into them. Both must outlive it.
    ArcPath(const ArcShape& shape, std::span<const double> from_mm, std::span<const double> to_mm);

    /// Distances of the ends from the centre, in mm.
    double radius_begin() const { return radius_begin_; }
    double radius_end() const { return radius_end_; }
    /// The angle of the whole arc in rad, above 0.
    double sweep() const { return sweep_; }
    /// The change of the angle with the share: the sweep, negative if clockwise.
    double turn() const { return sign() * sweep_; }
    /// The length of the path of all axes. For a spiral it is computed with the mean radius.
    double length_mm() const;
    /// The length of the path in the plane only.
    double plane_length_mm() const {
        return std::hypot(sweep_ * (radius_begin_ + radius_end_) / 2, radius_end_ - radius_begin_);
    }
    /// A point of the arc, for several questions about it.
    class Point;
    /// The point at a share of the angle, from 0 to 1. It must not outlive the arc.
    Point point(double share) const;
    /// The place of an axis at a share of the angle, from 0 to 1.
    double at(std::size_t axis, double share) const;
    std::vector<double> at(double share) const;
    /// The least and the greatest place of an axis.
    std::pair<double, double> extent(std::size_t axis) const;
    /// The derivative of an axis's place with respect to the share of the angle, in mm.
    double slope(std::size_t axis, double share) const;
    /// The direction of travel in the plane, of length 1, along its first and its second axis.
    std::pair<double, double> direction(double share) const;

    /// Visits the end of each chord in order; the last is the arc's end. A chord deviates by at most the tolerance.
    void each_chord(double tolerance_mm, const std::function<void(const std::vector<double>& to_mm)>& visit) const;

private:
    double sign() const { return shape_.is_clockwise ? -1 : 1; }
    double angle_at(double share) const { return begin_ + sign() * sweep_ * share; }
    double radius_at(double share) const { return radius_begin_ + (radius_end_ - radius_begin_) * share; }
    std::optional<double> extreme(double angle) const;

    ArcShape shape_;
    std::span<const double> from_;
    std::span<const double> to_;
    double radius_begin_ = 0;
    double radius_end_ = 0;
    double begin_ = 0;  // angle, counter-clockwise from the first axis
    double sweep_ = 0;
};

class ArcPath::Point {
public:
    /// The place of an axis in mm, and the derivative of the place with respect to the share.
    double at(std::size_t axis) const;
    double slope(std::size_t axis) const;
    /// The direction from the centre, along the plane's first and second axis.
    double cosine() const { return cosine_; }
    double sine() const { return sine_; }
    double radius() const { return radius_; }

private:
    friend class ArcPath;
    Point(const ArcPath& arc, double share);

    const ArcPath* arc_;
    double share_;
    double radius_;
    double cosine_;
    double sine_;
};

/// The radii of an arc's ends may differ by `error_mm`, or by `share` of the greater one up to 100 times `error_mm`.
struct ArcTolerance {
    double least_radius_mm;
    double error_mm;
    double share;
};
/// LinuxCNC's tolerance for programs in inches, which is the wider one, with room for rounding.
inline constexpr ArcTolerance kWidestArc{.least_radius_mm = 1e-6, .error_mm = 0.0719, .share = 0.00101};

/// Returns why an arc with these distances (mm) of its ends from the centre cannot be run, such as "does not close:
/// ...". Returns an empty text if it can be run.
std::string why_no_arc(double radius_begin, double radius_end, const ArcTolerance& tolerance = kWidestArc);
inline std::string why_no_arc(const ArcPath& arc) { return why_no_arc(arc.radius_begin(), arc.radius_end()); }

/// Visits the ends of the chords of a move. A straight move is one chord.
void each_chord(const ProgramMove& move, std::span<const double> from_mm, double tolerance_mm,
                const std::function<void(const std::vector<double>& to_mm)>& visit);

/// The length of the path of all axes.
double length_mm(const ProgramMove& move, std::span<const double> from_mm);

}  // namespace lockstep
