// The output of a segment in a failing test.
#pragma once

#include <ostream>

#include "core/step/segment.hpp"

namespace lockstep {

inline std::ostream& operator<<(std::ostream& out, const Segment& segment) {
    return out << "start " << segment.start.value << ", count " << segment.from.count() << ", phase "
               << segment.from.phase() << ", ticks " << segment.piece.ticks.value << ", velocity "
               << segment.piece.velocity.raw << ", acceleration " << segment.piece.acceleration.raw;
}

}  // namespace lockstep
