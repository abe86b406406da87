// The commanded curve of one move, a line or an arc, and the distance of places from it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/arc_path.hpp"
#include "core/indices.hpp"
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
    std::size_t axes() const { return line_.size(); }
    bool is_line() const { return arc_ == nullptr; }
    double length() const { return length_; }
    /// Of a line: the part of an axis in its unit vector, and the distance of a place's foot from its beginning.
    double direction(AxisIndex axis) const { return line_[axis].direction; }
    double from(AxisIndex axis) const { return line_[axis].from; }
    double along(std::span<const double> at_mm) const;
    /// Of an arc: its path, the axes of its plane, and the share of its angle at the nearest point found last.
    const ArcPath& arc() const { return arc_->path; }
    const ArcShape& plane() const { return arc_->shape; }
    double share() const { return share_; }

private:
    double of_line(std::span<const double> at_mm) const;
    double of_arc(std::span<const double> at_mm);

    struct Arc {
        Arc(std::vector<double> from_mm, std::vector<double> to_mm, const ArcShape& shape);
        std::vector<double> from;
        std::vector<double> to;
        ArcShape shape;
        ArcPath path;
    };
    struct Line {  // of an axis
        double from = 0;
        double direction = 0;  // of the unit vector
    };
    std::vector<Line> line_;
    double length_ = 0;               // of the line
    std::shared_ptr<const Arc> arc_;  // null for a line
    double share_ = 0;                // of the arc, at the nearest point found last
};

}  // namespace lockstep::analysis
