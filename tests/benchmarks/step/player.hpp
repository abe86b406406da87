// Plays a list of pieces through a StepEngine, window by window, as a controller does with frames.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/step/engine.hpp"
#include "tests/benchmarks/step/moves.hpp"

namespace lockstep::bench {

template <typename Engine>
class Player {
public:
    Player(std::vector<Piece> pieces, Position from) : engine_(Tick{}, from), pieces_(std::move(pieces)) {}

    bool done() const { return engine_.idle() && next_ == pieces_.size(); }

    /// Calls run(engine, until) for every piece that is in motion before `until`.
    template <typename Run>
    void play(Tick until, Run&& run) {
        while (engine_.now() < until && !done()) {
            if (engine_.idle()) {
                engine_.begin(pieces_[next_++]);
            }
            run(engine_, until);
        }
    }

private:
    Engine engine_;
    std::vector<Piece> pieces_;
    std::size_t next_ = 0;
};

/// Axis i of several that make the same number of steps, each a little slower than the one before.
inline std::vector<Piece> pieces_of_axis(Limits limits, int axis) {
    limits.max_velocity *= 1 - axis / 100.0;
    limits.acceleration *= 1 - axis / 200.0;
    return pieces_of(in_whole_ticks(limits));
}

}  // namespace lockstep::bench
