// The step engine of the product: the position of an axis, and the tick of each of its steps.
//
// It makes the same steps at the same ticks as the tick-by-tick form (tick_engine.hpp), but costs time per step instead
// of per tick. Work per call is bounded: a few stretches, and for each step a bounded search at worst.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "core/step/segment.hpp"
#include "core/step/walk.hpp"

namespace lockstep {

/// One axis in motion, piece after piece. At rest, with no piece, its velocity is 0.
class StepEngine {
public:
    /// At rest at position 0, tick 0.
    StepEngine() = default;
    StepEngine(Tick now, Position at) : now_(now), end_(now), position_(at) {}

    /// Begins a piece exactly at now() and position(). Drops the rest of an earlier piece.
    /// The piece must be executable() (executable.hpp). Otherwise the caller is defective and the process ends.
    void begin(const Piece& piece);

    /// Executes ticks until `until` or the end of the piece, whichever comes first; none if `until` is past.
    /// Calls on_step(StepEdge) for every step, in order. on_step returns nothing, or bool: false stops the engine right
    /// after that tick. It must not touch the engine. Returns the tick reached.
    template <typename OnStep>
    Tick run(Tick until, OnStep&& on_step);

    /// The parts of run(), for callers that find the steps of a stretch themselves (see walk.hpp). next() returns the
    /// next stretch, in motion and before `until`. pass() executes its first `ticks` ticks, which travel `travel`.
    Stretch next(Tick until, std::uint64_t crossover) const;
    void pass(const Stretch& stretch, std::int64_t ticks, Int128 travel);

    /// Advances to a later instant at rest. The position does not change.
    void wait(Tick until);
    /// Sets the position at rest, without a step.
    void rebase(Position at);
    /// Drops the rest of the piece: the axis is at rest here.
    void halt();

    Tick now() const { return now_; }
    Position position() const { return position_; }
    /// The velocity register after the last tick; 0 at rest. Before a piece's first tick it is the piece's seed.
    Velocity velocity() const { return idle() ? Velocity{} : velocity_; }
    bool idle() const { return now_ == end_; }
    Ticks remaining() const { return end_ - now_; }

private:
    Tick now_;
    Tick end_;
    Position position_;
    Velocity velocity_;
    Acceleration acceleration_;
};

inline Stretch StepEngine::next(Tick until, std::uint64_t crossover) const {
    return next_stretch(position_, velocity_, acceleration_, (until < end_ ? until : end_) - now_, crossover);
}

inline void StepEngine::pass(const Stretch& stretch, std::int64_t ticks, Int128 travel) {
    position_ = stretch.backward ? position_ - Displacement{travel} : position_ + Displacement{travel};
    const auto gained = static_cast<std::uint64_t>(ticks) * static_cast<std::uint64_t>(acceleration_.raw);
    velocity_.raw = static_cast<std::int64_t>(static_cast<std::uint64_t>(velocity_.raw) + gained);
    now_ += Ticks{ticks};
}

template <typename OnStep>
Tick StepEngine::run(Tick until, OnStep&& on_step) {
    bool going = true;
    while (going && now_ < until && !idle()) {
        const Stretch stretch = next(until, kCrossover);
        const auto direction = static_cast<std::int8_t>(stretch.backward ? -1 : 1);
        const std::int64_t ticks = walk(stretch, [&](std::int64_t n) {
            const StepEdge edge{now_ + Ticks{n}, direction};
            if constexpr (std::is_void_v<decltype(on_step(edge))>) {
                on_step(edge);
            } else {
                going = on_step(edge);
            }
            return going;
        });
        pass(stretch, ticks, stretch.travel(ticks));
    }
    return now_;
}

/// Calls on_step(StepEdge) for every step of an executable segment, in order.
template <typename OnStep>
void for_each_step(const Segment& segment, OnStep&& on_step) {
    StepEngine engine(segment.start, segment.from);
    engine.begin(segment.piece);
    engine.run(segment.end(), std::forward<OnStep>(on_step));
}

/// The change of the count by a segment: forward steps minus backward ones.
constexpr std::int64_t count_change(const Segment& segment) { return segment.to().count() - segment.from.count(); }

}  // namespace lockstep
