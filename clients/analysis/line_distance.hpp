// How far a point is from a path of straight lines in a plane.
#pragma once

#include <cstddef>
#include <vector>

namespace lockstep::analysis {

struct PlanePoint {
    double x = 0;
    double y = 0;
};

/// A path that answers many questions fast: its lines lie in blocks, and only blocks that may be nearer are searched.
class NearestLine {
public:
    /// Lines from each point to the next.
    void add(const std::vector<PlanePoint>& points);
    bool empty() const { return lines_.empty(); }
    /// To the nearest point of the nearest line, in the unit of the points. The path must not be empty. Quickest for
    /// points that follow each other.
    double distance(PlanePoint point);

private:
    struct Line {
        PlanePoint from;
        PlanePoint to;
    };
    struct Block {
        PlanePoint low;
        PlanePoint high;
    };

    double distance_in(std::size_t block, PlanePoint point) const;

    std::vector<Line> lines_;
    std::vector<Block> blocks_;  // of kBlock lines each
    std::size_t latest_ = 0;     // the block that was nearest
};

}  // namespace lockstep::analysis
