// Probing moves: the inputs at whose first touch a leg ends, and the place of the touch.
#pragma once

#include <optional>

#include "core/coordinator/epoch/epoch_runner.hpp"
#include "core/coordinator/jobs/path_task.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class Probing {
public:
    /// Ends a task whose probe touches before its move begins, or whose move moves nothing. Returns nullopt if the move
    /// can begin. `inputs`: the probe's.
    std::optional<Probed> end_at_begin(const PathTask& task, const TouchInputs& inputs, bool moves,
                                       const LoopView& loop);
    /// The inputs at whose touch the newest probing move ends: if at their opening, those that were closed at its
    /// begin.
    const TouchInputs& awaited() const { return awaited_; }

    /// An epoch begins, with the motors at these places.
    void begin_epoch(const MotorPositions& at, const LoopView& loop) { begun_at_ = at, plays_ = loop.plays(); }
    /// An epoch with a touch has come to rest as `end` says, but a touch before that, or one before the touch that is
    /// known, may still become known: an input follows its pin with a delay, and the states of its axis come later.
    bool may_touch_yet(const PathTask& task, const EpochEnd& end, const EpochRunner& runner, const LoopView& loop);
    /// The epoch rests, and may_touch_yet().
    bool waits() const { return rested_.has_value(); }
    /// Changes the end of an epoch in which a motor does not rest where its pulses had to cease.
    static void check_place(EpochEnd& end, const EpochRunner& runner, const LoopView& loop);
    /// Ends a task whose epoch ended behind a touch, or at the end of its move without one. Returns nullopt if it was
    /// interrupted before.
    std::optional<Probed> end(const PathTask& task, const EpochEnd& end, const EpochRunner& runner,
                              const LoopView& loop);

    const std::optional<ProbeResult>& result() const { return result_; }

private:
    MotorPositions slides_at(MotorPositions at, const LoopView& loop) const;
    bool lacks_states(const Probe& probe, const EpochRunner& runner, const LoopView& loop) const;
    void note(const PathTask& task, const std::optional<FirstTouch>& touch, const MotorPositions& at,
              const LoopView& loop);

    TouchInputs awaited_;
    MotorPositions begun_at_;            // of the newest epoch
    AxisCounts plays_;                   // there; none if no motor has backlash
    std::optional<ProbeResult> result_;  // of the newest probing move
    std::optional<Slot> rested_;         // since when the epoch in progress rests and waits
};

}  // namespace lockstep
