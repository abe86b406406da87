// Runs with any frames, for properties of a device.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {

struct Run {
    std::vector<device::LoadFrame> frames;
    FrameNumber armed = 0;
    FrameNumber vetoed = 0;

    /// The last frame whose body is run; 0: none.
    FrameNumber ran() const { return std::min({armed, vetoed - 1, static_cast<FrameNumber>(frames.size())}); }
};

/// Any speed up to a step per 8 ticks, with an acceleration that keeps it below twice this speed.
inline rc::Gen<Piece> any_piece() {
    return rc::gen::map(
        rc::gen::tuple(rc::gen::inRange(1, 400), rc::gen::inRange(-1000, 1001), rc::gen::inRange(-9, 10)),
        [](const auto& parts) {
            const auto [ticks, speed, rate] = parts;
            const std::int64_t unit = std::int64_t{1} << 51;
            return Piece{Ticks{ticks}, {speed * unit}, {rate * (unit / 8)}};
        });
}

/// Consecutive frames. Half of the time the last one has the flag `last`. Some are armed, and some may be vetoed.
inline Run any_run() {
    Run run;
    const auto count = *rc::gen::inRange<FrameNumber>(1, 7);
    Tick tick{*rc::gen::inRange<std::int64_t>(1, 500)};
    Position from = rest_position(0, *rc::gen::arbitrary<bool>());
    for (FrameNumber number = 1; number <= count; ++number) {
        device::LoadFrame frame{number, tick, false, {from, {}, {}}};
        for (int pieces = *rc::gen::inRange(1, 5); pieces > 0; --pieces) {
            const Piece piece = *any_piece();
            (void)frame.track.body.push_back(piece);
            tick += piece.ticks;
            from = from + piece.covered();
        }
        for (int pieces = *rc::gen::inRange(0, 4); pieces > 0; --pieces) {
            (void)frame.track.tail.push_back(*any_piece());
        }
        run.frames.push_back(frame);
    }
    run.frames.back().last = *rc::gen::arbitrary<bool>();
    run.armed = *rc::gen::inRange<FrameNumber>(0, count + 2);
    run.vetoed = *rc::gen::inRange<FrameNumber>(1, count + 2);
    return run;
}

/// A time until the next call. It does not shrink, because shorter times make more calls: up to one for each tick.
inline Ticks any_time_to_next_call(std::int64_t below) {
    return Ticks{*rc::gen::noShrink(rc::gen::inRange<std::int64_t>(1, below))};
}

}  // namespace lockstep
