// Where on a program the machine rests, or goes on.
#pragma once

#include <cstdint>

#include "core/units.hpp"

namespace lockstep {

/// In `block` of the program, so far `along` its move, in 2^-64 mm. By the LAI method: in 2^-64 steps of the lead axis.
struct PathPlace {
    std::uint32_t block = 0;
    Displacement along;
    bool operator==(const PathPlace&) const = default;
};

}  // namespace lockstep
