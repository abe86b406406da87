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
// A motion from rest to rest or between reversals that is shorter than a window counts as one window.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "clients/analysis/measure/course.hpp"
#include "core/step/segment.hpp"

namespace lockstep::analysis {

class SpeedMeter {
public:
    /// After this time without a step an axis is at rest, and the window starts again.
    static constexpr Ticks kRest{100'000};

    /// Takes the next step, in order. Returns the signed speed in the window that it completes, at the window's middle;
    /// nullopt if it completes none.
    std::optional<Sample> step(StepEdge edge);
    /// The signed acceleration between the two windows that the latest step completed; nullopt if it completed none.
    const std::optional<Sample>& acceleration() const { return acceleration_; }
    /// Ends the motion: later steps do not join the previous ones.
    void interrupt();

    double peak_steps_per_tick() const { return peak_speed_; }          // in either direction
    double peak_steps_per_tick2() const { return peak_acceleration_; }  // speeding up or slowing down

private:
    static constexpr std::size_t kLeastSteps = 8;
    static constexpr Ticks kSpeedWindow{1'000};
    static constexpr Ticks kAccelerationWindow{10'000};
    static constexpr std::size_t kKept = 2'048;

    /// A step of this motion, and the window of acceleration that it completed.
    struct Past {
        Tick tick;
        Tick window_from;
        double window_speed = 0;
        bool is_window = false;
    };

    bool is_wide(std::size_t first, Ticks least) const;
    bool narrow(std::size_t& first, Ticks least) const;
    double speed_since(std::size_t first) const;
    std::optional<Sample> measure_speed();
    void measure_acceleration();
    void begin_stretch(StepEdge edge, bool rested);
    void forget();

    static double middle(Tick from, Tick to) {
        return static_cast<double>(from.value) / 2 + static_cast<double>(to.value) / 2;
    }

    std::vector<Past> past_;       // the newest steps of this motion, with which a window may still begin
    std::size_t room_ = kKept;     // maximum size of past_ before the oldest are dropped
    std::size_t speed_first_ = 0;  // begin of the windows that end with the newest step
    std::size_t late_first_ = 0;
    std::int8_t direction_ = 0;
    bool measured_ = false;  // a whole window of this motion
    std::optional<Sample> acceleration_;
    double peak_speed_ = 0;
    double peak_acceleration_ = 0;
};

inline std::optional<Sample> SpeedMeter::step(StepEdge edge) {
    const bool rested = !past_.empty() && edge.tick - past_.back().tick > kRest;
    if (rested || edge.direction != direction_) { begin_stretch(edge, rested); }
    if (past_.size() == room_) { forget(); }
    past_.push_back({.tick = edge.tick, .window_from = {}});
    measure_acceleration();
    return measure_speed();
}

inline std::optional<Sample> SpeedMeter::measure_speed() {
    if (!narrow(speed_first_, kSpeedWindow)) { return std::nullopt; }
    measured_ = true;
    const double speed = speed_since(speed_first_);
    peak_speed_ = std::max(peak_speed_, speed);
    const Tick first = past_[speed_first_].tick;
    return Sample{first + Ticks{(past_.back().tick - first).value / 2}, direction_ * speed};
}

/// The later window ends with the newest step. The earlier window ends with the first step of the later one.
inline void SpeedMeter::measure_acceleration() {
    acceleration_.reset();
    if (!narrow(late_first_, kAccelerationWindow)) { return; }
    Past& late = past_.back();
    const Past& early = past_[late_first_];
    late.window_from = early.tick;
    late.window_speed = speed_since(late_first_);
    late.is_window = true;
    if (!early.is_window) { return; }
    const double time = middle(late.window_from, late.tick) - middle(early.window_from, early.tick);
    const double acceleration = (late.window_speed - early.window_speed) / time;
    acceleration_ = Sample{early.tick, direction_ * acceleration};
    peak_acceleration_ = std::max(peak_acceleration_, std::abs(acceleration));
}

/// Whether the steps from `first` to the newest are enough for a window.
inline bool SpeedMeter::is_wide(std::size_t first, Ticks least) const {
    return past_.size() > first + kLeastSteps && past_.back().tick - past_[first].tick >= least;
}

/// Moves the window's first step as late as possible. Returns false if there is no window yet.
inline bool SpeedMeter::narrow(std::size_t& first, Ticks least) const {
    if (!is_wide(first, least)) { return false; }
    while (is_wide(first + 1, least)) { ++first; }
    return true;
}

inline double SpeedMeter::speed_since(std::size_t first) const {
    return static_cast<double>(past_.size() - 1 - first) /
           static_cast<double>((past_.back().tick - past_[first].tick).value);
}

}  // namespace lockstep::analysis
