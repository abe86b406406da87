// The commanded curve of one move, a line or an arc, and the distance of places from it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/arc_path.hpp"
#include "core/program.hpp"

namespace lockstep::analysis {

class AskedShape {
public:
    AskedShape() = default;
    /// Places have one number per axis of the machine, in mm or degrees. `arc`: its axes are indices into them.
    AskedShape(std::vector<double> from_mm, std::vector<double> to_mm, std::optional<ArcShape> arc);

    /// The square of the distance of a place from the curve, in mm^2. For arcs the nearest point is sought from the
    /// one before, so successive places should be near each other.
    double square_of_distance(std::span<const double> at_mm);

private:
    double of_line(std::span<const double> at_mm) const;
    double of_arc(std::span<const double> at_mm);

    std::vector<double> from_;
    std::vector<double> to_;
    std::vector<double> direction_;  // of a line, as a unit vector
    double length_ = 0;              // of a line
    std::optional<ArcShape> arc_;
    double share_ = 0;  // of the arc, at the nearest point found last
};

}  // namespace lockstep::analysis
