// Where on a program the machine rests, or goes on.
#pragma once

#include <cstdint>

#include "core/units.hpp"

namespace lockstep {

/// In `block` of the program, `along` the lead axis of its move, in 2^-64 steps.
struct PathPlace {
    std::uint32_t block = 0;
    Displacement along;
    bool operator==(const PathPlace&) const = default;
};

}  // namespace lockstep
