// The play of the axis's motor, along the pieces that its device has run.
#pragma once

#include <cstdint>

#include "core/axis/state/axis_io.hpp"
#include "core/kinematics/backlash.hpp"

namespace lockstep {

class FollowedPlay {
public:
    explicit FollowedPlay(const Backlash& backlash) : play_(backlash) {}

    /// It is `steps` where the device has this count.
    void begin(std::int64_t steps, std::int64_t count) {
        play_.set(steps);
        count_ = count;
    }
    /// The device has run this.
    void follow(const ExecutedTrack& track);
    std::int64_t steps() const { return play_.steps(); }
    /// The play at this count of the device. Its motion since the last track is taken to have one direction.
    std::int64_t at(std::int64_t count) const {
        Play now = play_;
        now.follow(count - count_);
        return now.steps();
    }

private:
    Play play_;
    std::int64_t count_ = 0;  // at the end of the last track
};

}  // namespace lockstep
