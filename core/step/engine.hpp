// The step engine the product runs: where every axis is, and the tick of every step it makes.
//
// It makes the steps of the tick-by-tick form (tick_engine.hpp), at the same ticks, for a cost per step instead of per
// tick. Work per call is bounded: a few stretches, and for each step a bounded search at worst.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "core/step/segment.hpp"
#include "core/step/walk.hpp"

namespace lockstep {

/// What was done of a stretch: how many of its ticks, and whether to go on.
struct Walked {
    std::int64_t ticks = 0;
    bool going = true;
};

/// One axis in motion, piece after piece. At rest, with no piece, its velocity is 0.
class StepEngine {
public:
    /// At rest at position 0, tick 0.
    StepEngine() = default;
    StepEngine(Tick now, Position at) : now_(now), end_(now), position_(at) {}

    /// Begins a piece at now(), from position(), continuing exactly. Any piece before it is forgotten.
    /// The piece must be executable() (executable.hpp): anything else is a defect of the caller and ends the process.
    void begin(const Piece& piece);

    /// Executes ticks until `until` or the end of the piece, whichever comes first; none where `until` is past.
    /// Calls on_step(StepEdge) for every step, in order. on_step returns nothing, or bool: false stops the engine right
    /// after that tick. It must not touch the engine. Returns the tick reached.
    template <typename OnStep>
    Tick run(Tick until, OnStep&& on_step);

    /// The same, stretch by stretch, for those who find the steps of a stretch their own way: calls
    /// walk(Stretch, Tick of its start) for each in order, which returns what it has done of it. See walk.hpp.
    template <typename Walk>
    Tick run_stretches(Tick until, std::uint64_t crossover, Walk&& walk_stretch);

    /// To a later instant, at rest, position unchanged.
    void wait(Tick until);
    /// Another name for where the axis stands, at rest.
    void rebase(Position at);
    /// Forgets the rest of the piece: at rest here.
    void halt();

    Tick now() const { return now_; }
    Position position() const { return position_; }
    /// The register after the last tick; 0 at rest. Before a piece's first tick, its seed.
    Velocity velocity() const { return idle() ? Velocity{} : velocity_; }
    bool idle() const { return now_ == end_; }
    Ticks remaining() const { return end_ - now_; }

private:
    void advance(const Stretch& stretch, std::int64_t ticks);

    Tick now_;
    Tick end_;
    Position position_;
    Velocity velocity_;
    Acceleration acceleration_;
};

template <typename Walk>
Tick StepEngine::run_stretches(Tick until, std::uint64_t crossover, Walk&& walk_stretch) {
    Walked walked;
    while (walked.going && now_ < until && !idle()) {
        const Ticks ticks = (until < end_ ? until : end_) - now_;
        const Stretch stretch = next_stretch(position_, velocity_, acceleration_, ticks, crossover);
        walked = walk_stretch(stretch, now_);
        advance(stretch, walked.ticks);
    }
    return now_;
}

template <typename OnStep>
Tick StepEngine::run(Tick until, OnStep&& on_step) {
    return run_stretches(until, kCrossover, [&](const Stretch& stretch, Tick start) {
        const auto direction = static_cast<std::int8_t>(stretch.backward ? -1 : 1);
        bool going = true;
        const std::int64_t ticks = walk(stretch, [&](std::int64_t n) {
            const StepEdge edge{start + Ticks{n}, direction};
            if constexpr (std::is_void_v<decltype(on_step(edge))>) {
                on_step(edge);
            } else {
                going = on_step(edge);
            }
            return going;
        });
        return Walked{ticks, going};
    });
}

/// Calls on_step(StepEdge) for every step of an executable segment, in order.
template <typename OnStep>
void for_each_step(const Segment& segment, OnStep&& on_step) {
    StepEngine engine(segment.start, segment.from);
    engine.begin(segment.piece);
    engine.run(segment.end(), std::forward<OnStep>(on_step));
}

/// By how many steps a segment changes the count: forward steps minus backward ones.
constexpr std::int64_t count_change(const Segment& segment) { return segment.to().count() - segment.from.count(); }

}  // namespace lockstep
