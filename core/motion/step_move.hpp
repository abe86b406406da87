// A move of one axis, as input of the methods of step generation.
#pragma once

#include <cstdint>

namespace lockstep {

/// A straight move from rest to rest. Speeds in steps/s, accelerations in steps/s^2.
struct StepMove {
    std::int64_t steps = 0;
    double start = 0;  // speed of a jump from rest, and of one to rest
    double max = 0;
    double acceleration = 0;
    double deceleration = 0;
    bool operator==(const StepMove&) const = default;
};

/// The position at which a method makes step k: k, or k - 1/2.
enum class Crossing { Whole, Half };

}  // namespace lockstep
