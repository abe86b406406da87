// Finds the move that a motor's step belongs to.
#pragma once

#include <cstddef>
#include <cstdint>

#include "clients/analysis/asked/asked_path.hpp"

namespace lockstep::analysis {

/// Finds the next stroke of one motor through a place.
class MoveCursor {
public:
    /// Goes to the stroke in which a motor steps from `count` in `direction`. Returns false if none of the next kReach
    /// strokes is it.
    /// `beyond()`: steps by which a reversal may be later than planned.
    template <typename Beyond>
    bool find(const AskedPath& asked, MotorIndex motor, std::int64_t count, int direction, Beyond&& beyond) {
        return is_in_stroke(count, direction) || find_next(asked, motor, count, direction, beyond());
    }
    bool is_in_stroke(std::int64_t count, int direction) const { return stroke_.has(count, direction); }
    /// The number of steps from `count` to the end of the stroke.
    std::int64_t steps_from(std::int64_t count) const { return (stroke_.to - count) * stroke_.direction(); }
    /// The number of the move.
    std::size_t move() const { return stroke_.move; }

private:
    static constexpr std::size_t kReach = 64;  // strokes searched, because steps may be missing from the log
    static constexpr std::size_t kNear = 3;    // strokes of which one is likely

    bool find_next(const AskedPath& asked, MotorIndex motor, std::int64_t count, int direction, std::int64_t beyond);
    bool find_among(const AskedPath& asked, MotorIndex motor, std::size_t first, std::size_t end, std::int64_t count,
                    int direction);

    std::size_t next_ = 0;      // index in the motor's strokes
    AskedPath::Stroke stroke_;  // found last
};

}  // namespace lockstep::analysis
