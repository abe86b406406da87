// A move of one axis as the methods of step generation take it.
#pragma once

#include <cstdint>

namespace lockstep {

/// A straight move from rest to rest. Speeds in steps/s, accelerations in steps/s^2.
struct StepMove {
    std::int64_t steps = 0;
    double start = 0;  // jumped to from rest, and from it to rest
    double max = 0;
    double acceleration = 0;
    double deceleration = 0;
    bool operator==(const StepMove&) const = default;
};

/// Where a method means a step to fall: step k where the position is k, or where it is k - 1/2.
enum class Crossing { Whole, Half };

}  // namespace lockstep
