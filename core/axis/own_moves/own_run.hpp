// One run of frames that an axis makes for itself, loaded as the device takes them. A run that is given no further
// frame rests by its tail.
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
    /// how long the device goes on if this process stalls.
    OwnRun(const LocalMove& move, OwnMove frames, std::int64_t target, int tries, Ticks ahead)
        : move_(move), frames_(std::move(frames)), ahead_(ahead), target_(target), tries_(tries) {}

    /// A jog: the device gets no frame that ends later than this, whatever `ahead` is. Times only rise.
    void allow_until(Tick until) { until_ = std::max(until_.value_or(until), until); }
    bool is_jog() const { return until_.has_value(); }

    /// Loads frames until the device has enough ahead, or no room.
    void feed(AxisLoop& loop);
    /// The device ends the frame in progress and runs its tail: it brakes within the length of a frame.
    void halt(AxisLoop& loop);
    void record(const DeviceStatus& device, AxisLoop& loop);

    bool is_halted() const { return is_halted_; }
    /// The method has made of the move what the limits forbid.
    bool is_broken() const { return frames_.broken(); }
    /// When the run has ended: what is left of the move where only this process is to blame, which came too late with
    /// the start or with a frame. Nothing: the move is done, or a switch or a halt ended it.
    std::optional<LocalMove> rest(const DeviceStatus& device) const;
    /// How often the start of what is left has been missed.
    int tries_of_rest(const DeviceStatus& device) const { return device.frame > 0 ? 0 : tries_ + 1; }

private:
    bool may_load(const HeldFrame& frame) const;

    LocalMove move_;
    OwnMove frames_;                    // those to come
    HeldFrames held_{64};               // those loaded and not yet recorded
    std::optional<HeldFrame> waiting_;  // made, but the device's ring has no room for it
    RunRecorder recorder_;
    Ticks ahead_;
    std::int64_t target_;
    std::optional<Tick> until_;
    int tries_;
    bool is_halted_ = false;
};

}  // namespace lockstep
