// Frames of a motor, and the steps that core/step makes of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "core/step/tick_engine.hpp"
#include "services/axis/device_driver.hpp"
#include "tests/simulation/board/pin_watch.hpp"

namespace lockstep::testing {

struct Course {
    std::vector<device::LoadFrame> frames;
    FrameNumber armed;
    std::vector<StepEdge> steps;  // of the armed frames, and of a tail behind them
    Tick end;
};

/// At most a step per 16 ticks, either way.
inline std::int64_t any_speed(std::mt19937_64& random) {
    const auto speed = static_cast<std::int64_t>(random() / 16);
    return random() % 4 == 0 ? -speed : speed;
}

inline Piece any_piece(std::mt19937_64& random, std::int64_t most_ticks) {
    const std::int64_t speed = any_speed(random);
    const Ticks ticks{128 + static_cast<std::int64_t>(random() % 10'000) % most_ticks};
    return {ticks, {speed}, {(any_speed(random) - speed) / ticks.value}};
}

/// The steps of pieces from a tick and a place on, which move to their end.
template <typename Pieces>
void append_steps(const Pieces& pieces, Tick& tick, Position& at, std::vector<StepEdge>& steps) {
    for (const Piece& piece : pieces) {
        tick_by_tick({tick, at, piece}, [&](StepEdge step) { steps.push_back(step); });
        tick += piece.ticks;
        at = at + piece.covered();
    }
}

inline constexpr FrameNumber kFrames = 4;

/// Frames of any pieces, one of which has many.
inline Course course(std::uint64_t seed, Tick start, FrameNumber armed) {
    std::mt19937_64 random(seed);
    Course result{{}, armed, {}, start};
    Position at = rest_position(0, false);
    std::vector<StepEdge> not_armed;
    for (FrameNumber number = 1; number <= kFrames; ++number) {
        device::LoadFrame frame{number, start, number == kFrames, {at, {}, {}}};
        const std::int64_t pieces = number == 2 ? 40 : 5;
        for (std::int64_t left = pieces; left > 0; --left) {
            frame.track.body.append(any_piece(random, 10'000 / pieces));
        }
        append_steps(frame.track.body, start, at, number <= armed ? result.steps : not_armed);
        if (!frame.last) { frame.track.tail.append(any_piece(random, 2000)); }
        if (number == armed) {
            result.end = start;
            Position rest = at;
            append_steps(frame.track.tail, result.end, rest, result.steps);
        }
        result.frames.push_back(frame);
    }
    return result;
}

/// To and fro at a step per 20 ticks, for 80 pieces.
inline Course turns(std::uint64_t seed, Tick start) {
    std::mt19937_64 random(seed);
    Course result{{}, kFrames, {}, start};
    Position at = rest_position(0, false);
    std::int64_t speed = std::numeric_limits<std::int64_t>::max() / 10;
    for (FrameNumber number = 1; number <= kFrames; ++number) {
        device::LoadFrame frame{number, result.end, number == kFrames, {at, {}, {}}};
        for (int left = 20; left > 0; --left) {
            frame.track.body.append({Ticks{300 + static_cast<std::int64_t>(random() % 250)}, {speed}, {}});
            speed = -speed;
        }
        append_steps(frame.track.body, result.end, at, result.steps);
        result.frames.push_back(frame);
    }
    return result;
}

/// Forward, at a step per 20 ticks.
inline Course long_way(Tick start, Ticks ticks) {
    const Piece piece{ticks, {std::numeric_limits<std::int64_t>::max() / 10}, {}};
    Course result{{{1, start, true, {rest_position(0, false), {piece}, {}}}}, 1, {}, start};
    Position at = rest_position(0, false);
    append_steps(result.frames.front().track.body, result.end, at, result.steps);
    return result;
}

/// Without each step that the opposite one follows before the pins could turn: neither comes to the pins.
inline std::vector<StepEdge> without_short_turns(const std::vector<StepEdge>& steps) {
    std::vector<StepEdge> edges;
    bool is_open = false;  // the last edge may be taken back
    for (const StepEdge& step : steps) {
        const bool turns = is_open && step.direction != edges.back().direction;
        if (turns && step.tick - edges.back().tick < Ticks{kLeastStep}) {
            edges.pop_back();
            is_open = false;
        } else {
            edges.push_back(step);
            is_open = true;
        }
    }
    return edges;
}

}  // namespace lockstep::testing
