#include "core/path/path_speed.hpp"

#include <algorithm>

namespace lockstep {

void list_speeds(const TimedPath& path, Ticks length, std::vector<PathSpeed>& speeds) {
    speeds.clear();
    for (const PathPhase& phase : path.phases()) {
        const double begin = std::max(phase.begin, 0.0);
        const double end = std::min(phase.end(), static_cast<double>(length.value));
        if (end <= begin) { continue; }
        const bool rests = phase.shape->length == 0 || phase.shape->is_aside;
        speeds.push_back({.begin = begin,
                          .ticks = end - begin,
                          .v = rests ? 0 : phase.speed(begin),
                          .a = rests ? 0 : phase.a,
                          .feed = rests ? 0 : phase.shape->feed_mm_per_tick.value_or(0)});
    }
}

}  // namespace lockstep
