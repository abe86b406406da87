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
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/measure/course.hpp"
#include "core/step/segment.hpp"

namespace lockstep::analysis {

class SpeedMeter {
public:
    /// After this time without a step an axis is at rest, and the window starts again.
    static constexpr Ticks kRest{100'000};
    /// The number of steps in a block.
    static constexpr std::size_t kBlock = SampleBlock::kSize;

    /// Takes the next step, in order. Returns the signed speed in the window that it completes, at the window's middle;
    /// nullopt if it completes none.
    std::optional<Sample> step(StepEdge edge);
    /// The signed acceleration between the two windows that the latest step completed; nullopt if it completed none.
    const std::optional<Sample>& acceleration() const { return acceleration_; }
    /// What step() and acceleration() return for each step of a block.
    struct Block {
        SampleBlock speed;
        SampleBlock acceleration;
    };
    /// Takes the next steps in whole blocks, which costs less, as long as they certainly complete all windows. Returns
    /// their number. Call measure_block() for each block before further steps.
    std::size_t take_blocks(std::span<const StepEdge> edges);
    void measure_block(Block& measured);
    /// Ends the motion: later steps do not join the previous ones.
    void interrupt();

    double peak_steps_per_tick() const { return peak_speed_; }          // in either direction
    double peak_steps_per_tick2() const { return peak_acceleration_; }  // speeding up or slowing down

private:
    static constexpr std::size_t kLeastSteps = 8;
    static constexpr std::int32_t kSpeedWindow = 1'000;
    static constexpr std::int32_t kAccelerationWindow = 10'000;
    static constexpr std::size_t kKept = 4'096;
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

    static constexpr std::int32_t kLanes = kBlock;
    /// Of the windows that end with the steps of a block: indices into past_.
    using Begins = std::array<std::int32_t, kBlock>;

    /// Of half of the steps of a block.
    struct Window {
        HalfIntLanes first;  // tick
        HalfIntLanes ticks;
        HalfIntLanes steps;
    };

    Begins ticks_at(const Begins& begins) const;
    Window window_of(std::size_t from, std::size_t half, const Begins& begins, const Begins& firsts) const;
    bool narrow(std::size_t& first, std::int32_t least, std::size_t newest) const;
    void narrow_all(std::size_t& first, std::int32_t least, std::size_t from, Begins& begins) const;
    bool narrow_near(std::size_t first, std::int32_t least, std::size_t from, Begins& begins) const;
    double speed_since(std::size_t first, std::size_t newest) const;
    double least_speed_since(std::size_t first) const;
    std::size_t blocks_of_motion(std::span<const StepEdge> edges) const;
    void measure_speeds(std::size_t from, SampleBlock& measured);
    void measure_accelerations(std::size_t from, SampleBlock& measured);
    std::optional<Sample> measure_speed();
    void measure_acceleration();
    void add(Tick tick);
    void begin_stretch(StepEdge edge, bool rested);
    void forget();
    Tick tick(std::size_t step) const { return base_ + Ticks{past_[step]}; }
    /// Clocks of a damaged log may jump.
    bool is_far(Tick at) const {
        constexpr Ticks kFarthest{1 << 30};
        return !past_.empty() && length_of(at - base_) > kFarthest;
    }
    bool has_early_window(std::size_t step) const { return step >= windows_from_; }

    Tick base_;                       // of the ticks in past_ and window_from_
    std::vector<std::int32_t> past_;  // the newest steps of this motion, with which a window may still begin
    // The windows of acceleration that end with these steps, from step windows_from_ on: first tick and speed.
    std::vector<std::int32_t> window_from_;
    std::vector<double> window_speed_;
    std::size_t windows_from_ = kNone;
    std::size_t room_ = kKept;     // maximum size of past_ before the oldest are dropped
    std::size_t speed_first_ = 0;  // begin of the windows that end with the newest step
    std::size_t late_first_ = 0;
    std::size_t measured_until_ = 0;  // begin of the next block to be measured
    std::int8_t direction_ = 0;
    bool measured_ = false;  // a whole window of this motion
    std::optional<Sample> acceleration_;
    double peak_speed_ = 0;
    double peak_acceleration_ = 0;
};

inline std::optional<Sample> SpeedMeter::step(StepEdge edge) {
    const bool rested = !past_.empty() && edge.tick - tick(past_.size() - 1) > kRest;
    if (rested || edge.direction != direction_ || is_far(edge.tick)) { begin_stretch(edge, rested); }
    if (past_.size() >= room_) { forget(); }
    add(edge.tick);
    measure_acceleration();
    return measure_speed();
}

inline void SpeedMeter::add(Tick tick) {
    if (past_.empty()) { base_ = tick; }
    past_.push_back(static_cast<std::int32_t>((tick - base_).value));
    window_from_.push_back(0);
    window_speed_.push_back(0);
}

inline std::optional<Sample> SpeedMeter::measure_speed() {
    const std::size_t newest = past_.size() - 1;
    if (!narrow(speed_first_, kSpeedWindow, newest)) { return std::nullopt; }
    measured_ = true;
    const double speed = speed_since(speed_first_, newest);
    peak_speed_ = std::max(peak_speed_, speed);
    const std::int32_t first = past_[speed_first_];
    return Sample{base_ + Ticks{first + (past_[newest] - first) / 2}, direction_ * speed};
}

/// The later window ends with the newest step. The earlier window ends with the first step of the later one. The time
/// between their middles is half of both together.
inline void SpeedMeter::measure_acceleration() {
    acceleration_.reset();
    const std::size_t newest = past_.size() - 1;
    if (!narrow(late_first_, kAccelerationWindow, newest)) { return; }
    windows_from_ = std::min(windows_from_, newest);
    window_from_[newest] = past_[late_first_];
    window_speed_[newest] = speed_since(late_first_, newest);
    if (!has_early_window(late_first_)) { return; }
    const double ticks = 0.5 * (past_[newest] - window_from_[late_first_]);
    const double acceleration = (window_speed_[newest] - window_speed_[late_first_]) / ticks;
    acceleration_ = Sample{tick(late_first_), direction_ * acceleration};
    peak_acceleration_ = std::max(peak_acceleration_, std::abs(acceleration));
}

/// Moves the first step of the window that ends with `newest` as late as possible. Returns false if there is no window
/// yet.
inline bool SpeedMeter::narrow(std::size_t& first, std::int32_t least, std::size_t newest) const {
    if (newest < kLeastSteps) { return false; }
    const std::size_t most = newest - kLeastSteps;  // the latest step with which a window may begin
    const std::int32_t latest = past_[newest] - least;
    if (first > most || past_[first] > latest) { return false; }
    while (first < most && past_[first + 1] <= latest) { ++first; }
    return true;
}

inline double SpeedMeter::speed_since(std::size_t first, std::size_t newest) const {
    return static_cast<double>(newest - first) / static_cast<double>(past_[newest] - past_[first]);
}

}  // namespace lockstep::analysis
