// One run of frames that an axis makes for itself and loads as the device has room. A run that gets no further frame
// comes to rest by its tail.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/axis/own_moves/homing.hpp"
#include "core/axis/own_moves/own_move.hpp"
#include "core/axis/state/axis_loop.hpp"
#include "core/axis/state/run_recorder.hpp"

namespace lockstep {

class OwnRun {
public:
    /// `target`: the device's count at the end. `tries`: how often the start of this move was missed before. `ahead`:
    /// how long the device continues if this process stalls.
    OwnRun(const LocalMove& move, OwnMove frames, std::int64_t target, int tries, Ticks ahead)
        : move_(move), frames_(std::move(frames)), ahead_(ahead), target_(target), tries_(tries) {}

    /// Makes the run a jog. The device gets no frame that ends later than `until`, independently of `ahead`. The time
    /// only rises.
    void allow_until(Tick until) { until_ = std::max(until_.value_or(until), until); }
    bool is_jog() const { return until_.has_value(); }

    /// Loads frames until the device has enough ahead, or no room.
    void feed(AxisLoop& loop);
    /// The device ends the frame in progress and runs its tail. So it brakes within the length of a frame.
    void halt(AxisLoop& loop);
    void record(const DeviceStatus& device, AxisLoop& loop);

    bool is_halted() const { return is_halted_; }
    /// The method has broken the axis's limits.
    bool is_broken() const { return frames_.broken(); }
    /// Call it when the run has ended. Returns the rest of the move if the run ended early only because this process
    /// was late with the start or with a frame. Returns nullopt if the move is done, or if a switch or a halt ended it.
    std::optional<LocalMove> rest(const DeviceStatus& device) const;
    /// How often the start of the rest of the move has been missed.
    int tries_of_rest(const DeviceStatus& device) const { return device.frame > 0 ? 0 : tries_ + 1; }

private:
    bool may_load(const HeldFrame& frame) const;

    LocalMove move_;
    OwnMove frames_;                    // the frames to come
    HeldFrames held_{64};               // frames loaded and not yet recorded
    std::optional<HeldFrame> waiting_;  // made, but not loaded yet
    RunRecorder recorder_;
    Ticks ahead_;
    std::int64_t target_;
    std::optional<Tick> until_;
    int tries_;
    bool is_halted_ = false;
};

}  // namespace lockstep
