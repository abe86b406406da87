// The geometry of the solids that a simulated machine's probes touch: the gap between the probe's ball and each solid.
//
// Each solid goes down without end. Seen from a point, it has a height above its top and a distance from its side, both
// negative within. The gap follows from the two, and is exact at faces and at edges. On a tilted or waved top the
// height is divided by the slope's length there: exact on a plane, and for waves much longer than the ball within tip^2
// * wave / length^2.
#pragma once

#include <utility>

#include "core/device/workpiece_config.hpp"

namespace lockstep {

/// Where the axes X, Y and Z are, in mm.
struct WorkPlace {
    double x_mm = 0;
    double y_mm = 0;
    double z_mm = 0;
};

class Workpiece {
public:
    explicit Workpiece(WorkpieceConfig config) : config_(std::move(config)) {}

    /// The gap between the ball and the nearest solid that closes this probe, in mm; 0 or less: it touches. It changes
    /// by no more than the axes move. Infinite if no solid closes it.
    double gap_mm(int probe, const WorkPlace& axes) const;
    /// The height of a block's top, at a place as the block sees it.
    static double top_mm(const WorkBlock& block, double x_mm, double y_mm);

private:
    WorkpieceConfig config_;
};

}  // namespace lockstep
