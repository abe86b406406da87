// The place in a program where the machine rests or continues.
#pragma once

#include <cstdint>

#include "core/units.hpp"

namespace lockstep {

/// A distance `along` the move of `block`, in 2^-64 mm. With the LAI method it is in 2^-64 steps of the lead axis.
struct PathPlace {
    std::uint32_t block = 0;
    Displacement along;
    bool operator==(const PathPlace&) const = default;
};

}  // namespace lockstep
