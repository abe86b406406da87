// The solids that the probes of a simulated machine touch.
#pragma once

#include <vector>

namespace lockstep {

/// A round hole through a block, along Z.
struct WorkBore {
    double x_mm = 0;
    double y_mm = 0;
    double diameter_mm = 0;
    bool operator==(const WorkBore&) const = default;
};

/// A block with its sides along X and Y, unless it is turned. Its top may be tilted and waved.
struct WorkBlock {
    double x_min_mm = 0;
    double x_max_mm = 0;
    double y_min_mm = 0;
    double y_max_mm = 0;
    double top_mm = 0;          // at x_min and y_min
    double rise_x = 0;          // mm of Z for each mm of X
    double rise_y = 0;          // likewise of Y
    double wave_mm = 0;         // by how much the top is higher or lower at most
    double wave_length_mm = 0;  // in X and in Y
    std::vector<WorkBore> bores;
    double angle_deg = 0;  // turned about the corner at x_min and y_min, counterclockwise, with its bores
    int probe = 0;         // the number of the probe that it closes
    bool operator==(const WorkBlock&) const = default;
};

/// An upright cylinder: a boss, or a tool setter.
struct WorkPost {
    double x_mm = 0;
    double y_mm = 0;
    double diameter_mm = 0;
    double top_mm = 0;
    int probe = 0;
    bool operator==(const WorkPost&) const = default;
};

/// Places are those of the machine's axes X, Y and Z.
struct WorkpieceConfig {
    double tip_mm = 0;         // the diameter of the probe's ball
    double tip_length_mm = 0;  // from the place of the axes down to the ball's lowest point
    std::vector<WorkBlock> blocks;
    std::vector<WorkPost> posts;
    bool operator==(const WorkpieceConfig&) const = default;
};

}  // namespace lockstep
