#include "clients/analysis/moves/move_cursor.hpp"

#include <algorithm>

namespace lockstep::analysis {

bool MoveCursor::find_next(const AskedPath& asked, MotorIndex motor, std::int64_t count, int direction,
                           std::int64_t most_beyond) {
    const std::size_t end = std::min(asked.strokes_of(motor).size(), next_ + kReach);
    const std::size_t near = std::min(end, next_ + kNear);
    if (find_among(asked, motor, next_, near, count, direction)) { return true; }
    const bool goes_on = stroke_.direction() == direction && stroke_.to != stroke_.from;
    const std::int64_t beyond = (count - stroke_.to) * direction;
    if (goes_on && beyond >= 0 && beyond < most_beyond) { return true; }
    return find_among(asked, motor, near, end, count, direction);
}

bool MoveCursor::find_among(const AskedPath& asked, MotorIndex motor, std::size_t first, std::size_t end,
                            std::int64_t count, int direction) {
    const auto& strokes = asked.strokes_of(motor);
    for (std::size_t i = first; i < end; ++i) {
        if (!strokes[i].has(count, direction)) { continue; }
        next_ = i;
        stroke_ = strokes[i];
        return true;
    }
    return false;
}

}  // namespace lockstep::analysis
