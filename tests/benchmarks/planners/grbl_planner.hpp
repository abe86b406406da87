// The planner of grbl 1.1, written anew. It was not compared with grbl itself.
//
// - The axes' limits of velocity and acceleration, as each move's direction allows.
// - A corner's speed by the junction deviation ($11), with the acceleration that the axes allow along the change of
//   direction.
// - A buffer of blocks. The speed at the end of the block under way is the greatest from which the machine can come to
//   rest at the end of the last known block. When a block has been run, a new one is known: the sender is never late.
#pragma once

#include <limits>

#include "tests/benchmarks/planners/trapezoid.hpp"

namespace lockstep::planners {

/// The size of grbl's buffer. grbl never uses one of these blocks; here all are used.
inline constexpr std::size_t kGrblBlocks = 16;
inline constexpr std::size_t kAllBlocks = std::numeric_limits<std::size_t>::max();

/// The deviation at which a right-angled corner from the first axis to the second has their start velocity.
double junction_deviation_mm(const Limits& limits);

Speeds plan_by_grbl(const std::vector<StraightMove>& moves, const Limits& limits, double junction_deviation_mm,
                    std::size_t blocks);

}  // namespace lockstep::planners
