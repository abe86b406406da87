// What the pins of a motor did, against the times that a driver asks for.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/step/tick_engine.hpp"
#include "tests/simulation/board/emulated_board.hpp"

namespace lockstep::testing {

inline constexpr std::size_t kMotors = 3;
inline constexpr std::int64_t kTick_ns = 1000;
inline constexpr double kCyclesPerTick = 200;
inline constexpr double kDirectionToStep = 120;  // 600 ns

inline constexpr int kLeastStep = 16;  // in ticks, from one step to the next

/// The times that a motor's pins must keep, in ticks.
struct PinTimes {
    int pulse = 1;
    int delay = kLeastStep;  // from its tick to the pulse
    int setup = 0;           // from a change of direction to the pulse, and 600 ns more
};

inline unsigned step_pin(std::size_t motor) { return static_cast<unsigned>(2 + motor); }
inline unsigned direction_pin(std::size_t motor) { return static_cast<unsigned>(6 + motor); }

inline constexpr std::uint8_t kLightPin = 25;

/// A digital output's pin has another level after this tick.
struct LevelChange {
    Tick tick;
    bool is_high = false;
    bool operator==(const LevelChange&) const = default;
};

inline bool is_output(std::uint8_t pin) { return pin == 22 || (26 <= pin && pin <= 28); }

inline bool is_pwm(std::uint8_t pin) { return pin == 5 || pin == 9; }

/// The machine is as late as those of motors.
inline LevelChange level_change(const PinEdge& edge, double start) {
    const double ticks = (edge.cycle - start) / kCyclesPerTick;
    return {Tick{static_cast<std::int64_t>(std::floor(ticks)) - kLeastStep}, edge.is_high};
}

/// What the pins of a motor did, in ticks since the machines began.
class PinWatch {
public:
    void take(const PinEdge& edge, std::size_t motor, double start) {
        if (edge.pin == direction_pin(motor)) { turn(edge); }
        if (edge.pin != step_pin(motor)) { return; }
        if (!edge.is_high) {
            EXPECT_EQ(edge.cycle - rose_, times.pulse * kCyclesPerTick);
            return;
        }
        const double before = std::exchange(rose_, edge.cycle);
        const double ticks = (edge.cycle - start - kDirectionToStep) / kCyclesPerTick - times.delay;
        EXPECT_EQ(std::fmod(edge.cycle - start, kCyclesPerTick), kDirectionToStep) << "behind the tick";
        EXPECT_GE(edge.cycle - turned_, kDirectionToStep + times.setup * kCyclesPerTick);
        EXPECT_GE(edge.cycle - before, kLeastStep * kCyclesPerTick);
        steps.push_back({Tick{1 + static_cast<std::int64_t>(ticks)}, static_cast<std::int8_t>(is_forward_ ? 1 : -1)});
    }

    PinTimes times;
    std::vector<StepEdge> steps;

private:
    void turn(const PinEdge& edge) {
        EXPECT_GE(edge.cycle - rose_, times.pulse * kCyclesPerTick) << "a direction changes in a pulse";
        is_forward_ = edge.is_high;
        turned_ = edge.cycle;
    }

    bool is_forward_ = false;
    double rose_ = -100 * kCyclesPerTick;
    double turned_ = -100 * kCyclesPerTick;
};

}  // namespace lockstep::testing
