// The speed along the path in the time of a frame, for outputs that follow it.
#pragma once

#include <vector>

#include "core/path/timed_path.hpp"

namespace lockstep {

/// Some time of a body or tail in which the speed changes evenly.
struct PathSpeed {
    double begin = 0;  // ticks from the begin of the body or tail
    double ticks = 0;
    double v = 0;     // mm per tick, at `begin`
    double a = 0;     // mm per tick^2
    double feed = 0;  // mm per tick, as the program asks for it; 0 in rapid moves and at rest

    double end() const { return begin + ticks; }
    double at(double t) const { return v + a * (t - begin); }
};

/// Sets `speeds` to those of the first `length` of the path, in order.
void list_speeds(const TimedPath& path, Ticks length, std::vector<PathSpeed>& speeds);

}  // namespace lockstep
