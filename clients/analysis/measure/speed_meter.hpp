// Measures the rate of steps and its change, from the steps' ticks alone.
//
// A step's tick is a whole number, so the interval between two steps has an error of up to a tick. For consecutive
// steps this may be a large part of the interval. Both figures are therefore measured over windows of several steps:
//   speed         (steps in one direction) / (the ticks they took), over the latest window of at least 8 steps and
//                 1 000 ticks. A tick's rounding is then at most 0.1 %. The true speed occurs at some instant within
//                 the window. A peak shorter than the window is flattened.
//   acceleration  (speed in one window - speed in the previous window) / (time between their middles), with windows of
//                 at least 8 steps and 10 000 ticks. Rounding is then at most 2e-8 of the speed, per tick. A permitted
//                 jump of speed inside a window counts as acceleration spread over the window.
// A motion from rest to rest or between reversals that is shorter than a window counts as one window. Rounding may have
// shortened it by a tick, which matters in so few ticks, so its speed is that of a tick more.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "clients/analysis/measure/motion_windows.hpp"
#include "core/step/segment.hpp"

namespace lockstep::analysis {

class SpeedMeter {
public:
    /// After this time without a step an axis is at rest, and the window starts again.
    static constexpr Ticks kRest{100'000};
    /// The number of steps in a block.
    static constexpr std::size_t kBlock = MotionWindows::kBlock;

    /// Takes the next step, in order. Returns the signed speed in the window that it completes, at the window's middle;
    /// nullopt if it completes none.
    std::optional<Sample> step(StepEdge edge);
    /// The signed acceleration between the two windows that the latest step completed; nullopt if it completed none.
    const std::optional<Sample>& acceleration() const { return acceleration_; }
    /// What step() and acceleration() return for each step of a block.
    using Block = MotionWindows::Block;
    /// Takes the next steps in whole blocks, which costs less, as long as they certainly complete all windows. Returns
    /// their number. Call measure_block() for each block before further steps.
    std::size_t take_blocks(StepSpan steps);
    /// `rates`: of each step of the block.
    void measure_block(Block& measured, StepRates* rates);
    /// Ends the motion: later steps do not join the previous ones.
    void interrupt();

    double peak_steps_per_tick() const { return peak_speed_; }          // in either direction
    double peak_steps_per_tick2() const { return peak_acceleration_; }  // speeding up or slowing down

private:
    std::size_t blocks_of_motion(const StepSpan& steps) const;
    void begin_stretch(StepEdge edge, bool rested);

    MotionWindows windows_;
    std::size_t measured_until_ = 0;  // begin of the next block to be measured
    std::int8_t direction_ = 0;
    bool measured_ = false;  // a whole window of this motion
    std::optional<Sample> acceleration_;
    double peak_speed_ = 0;
    double peak_acceleration_ = 0;
};

}  // namespace lockstep::analysis
