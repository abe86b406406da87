// An arc, helix or spiral between two places: its length, its extent, and chords of it. For travel checks, estimates
// and pictures; the planner cuts arcs for itself (core/path/arc_cutter.hpp).
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

class ArcPath {
public:
    /// Places in mm, one number per axis that the shape's axes count. `from` and `to` must outlive it.
    ArcPath(const ArcShape& shape, std::span<const double> from_mm, std::span<const double> to_mm);

    /// Distances of the ends from the centre.
    double radius_begin() const { return radius_begin_; }
    double radius_end() const { return radius_end_; }
    /// The angle that it goes through, above 0.
    double sweep() const { return sweep_; }
    /// Along the path of all axes; a spiral's as if its radius were the mean.
    double length_mm() const;
    /// Of the axes of its plane alone.
    double plane_length_mm() const { return sweep_ * (radius_begin_ + radius_end_) / 2; }
    /// The place of an axis at a share of the angle, from 0 to 1.
    double at(std::size_t axis, double share) const;
    std::vector<double> at(double share) const;
    /// The least and the greatest place of an axis.
    std::pair<double, double> extent(std::size_t axis) const;
    /// The direction in the plane at a share of the angle, of length 1: its first and its second axis.
    double turn_first(double share) const { return -sign() * std::sin(angle_at(share)); }
    double turn_second(double share) const { return sign() * std::cos(angle_at(share)); }

    /// The end of each chord, in order; the last is the arc's own end. A chord leaves the arc by the tolerance at most.
    void each_chord(double tolerance_mm, const std::function<void(const std::vector<double>& to_mm)>& visit) const;

private:
    double sign() const { return shape_.is_clockwise ? -1 : 1; }
    double angle_at(double share) const { return begin_ + sign() * sweep_ * share; }

    ArcShape shape_;
    std::span<const double> from_;
    std::span<const double> to_;
    double radius_begin_ = 0;
    double radius_end_ = 0;
    double begin_ = 0;  // angle, counter-clockwise from the first axis
    double sweep_ = 0;
};

/// Why an arc with these distances (mm) of its ends from the centre cannot be run, as "does not close: ...": it has no
/// radius, or they differ by more than LinuxCNC's tolerances. Empty: it can.
std::string why_no_arc(double radius_begin, double radius_end);
inline std::string why_no_arc(const ArcPath& arc) { return why_no_arc(arc.radius_begin(), arc.radius_end()); }

/// The ends of the chords of a move: of a straight one, its end alone.
void each_chord(const ProgramMove& move, std::span<const double> from_mm, double tolerance_mm,
                const std::function<void(const std::vector<double>& to_mm)>& visit);

/// Along the path of all axes.
double length_mm(const ProgramMove& move, std::span<const double> from_mm);

}  // namespace lockstep
