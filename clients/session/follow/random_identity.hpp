// An identity that no other client shares.
#pragma once

#include <random>

#include "core/protocol/messages.hpp"

namespace lockstep {

inline Identity random_identity() {
    std::random_device source;
    return Identity{source()} << 32 | source();
}

}  // namespace lockstep
