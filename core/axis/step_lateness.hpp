// Measures how late each step was: the tick captured by the device minus the planned tick of the frame that was run.
#pragma once

#include <cstddef>
#include <vector>

#include "core/axis/axis_controller.hpp"
#include "core/step/engine.hpp"

namespace lockstep {

class StepLateness {
public:
    /// The greatest lateness or earliness of a step. A captured step further off belongs to another planned step.
    static constexpr Ticks kMost{100'000};
    /// How many captured steps may wait for their track. Beyond that the oldest are dropped, and their track is not
    /// compared.
    static constexpr std::size_t kMaxWaiting = std::size_t{1} << 16;

    StepLateness() : waiting_(kMaxWaiting) {}

    /// Takes every captured step, in order, in machine time.
    void made(StepEdge step);

    /// Takes every body and tail that was run, in order, as commanded, after its steps were made. Calls on_step(Ticks
    /// late) for each of its steps, up to the first one that is missing.
    template <typename OnStep>
    void ran(const ExecutedTrack& track, OnStep&& on_step);

private:
    StepEdge front() const { return waiting_[first_ % kMaxWaiting]; }
    bool is_next(StepEdge planned) const;
    void forget_until(Tick tick);

    std::vector<StepEdge> waiting_;  // a ring
    std::size_t first_ = 0;
    std::size_t end_ = 0;
};

template <typename OnStep>
void StepLateness::ran(const ExecutedTrack& track, OnStep&& on_step) {
    forget_until(track.start - kMost);
    StepEngine engine(track.start, track.from);
    bool together = true;
    for (const Piece& piece : track.pieces) {
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks, [&](StepEdge planned) {
            together = together && is_next(planned);
            if (!together) { return false; }
            on_step(front().tick - planned.tick);
            ++first_;
            return true;
        });
        if (!together) { return forget_until(engine.now()); }
    }
}

}  // namespace lockstep
