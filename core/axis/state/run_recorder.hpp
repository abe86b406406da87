// Records what the device has run, frame by frame.
#pragma once

#include <cstdint>

#include "core/axis/device/held_frames.hpp"
#include "core/axis/state/axis_io.hpp"

namespace lockstep {

/// Records one run after the other.
class RunRecorder {
public:
    void begin() { recorded_ = 0; }

    struct Run {
        Epoch epoch = 0;  // 0: the axis's own move
        std::int64_t zero_count = 0;
    };
    /// Call it in each loop of a run. Records each body when the next has begun, and the last body with its tail when
    /// the run has ended. Removes recorded frames from `frames`.
    void take(const DeviceStatus& device, const Run& run, HeldFrames& frames, ReusedVector<ExecutedTrack>& tracks);

private:
    FrameNumber recorded_ = 0;  // how many bodies of the run are recorded
};

}  // namespace lockstep
