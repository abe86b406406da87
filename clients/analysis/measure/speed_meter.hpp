// The rate of steps, and how fast it changes, from their ticks alone.
//
// A step's tick is a whole number, so the interval between two steps is off by up to a tick; between neighbours that
// may be a large part of it. Both figures are therefore taken over windows of several steps:
//   speed         n steps of one direction / the ticks they took, over the latest window of at least 8 steps and
// 1 000 ticks. A tick's rounding is then at most 0.1 %. The true speed occurs at some instant within
//                 the window; a peak shorter than the window is flattened.
//   acceleration  (speed in one window - speed in the window before) / the time between their middles, windows of at
//                 least 8 steps and 10 000 ticks. Rounding then is at most 2e-8 of the speed, per tick. A permitted
//                 jump of speed inside a window counts as acceleration spread over it.
// A motion from rest to rest, or from reversal to reversal, that is shorter than a window counts as one.
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
    /// After so long without a step an axis is at rest; the window starts again.
    static constexpr Ticks kRest{100'000};

    /// Takes the next step, in order. Returns the speed in the window it completes, at the window's middle, signed.
    std::optional<Sample> step(StepEdge edge);
    /// The acceleration between the two windows that the latest step completed, signed; none: it completed none.
    const std::optional<Sample>& acceleration() const { return acceleration_; }
    /// Later steps do not join those before. Also ends the last motion.
    void interrupt();

    double peak_steps_per_tick() const { return peak_speed_; }          // either way
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

    std::vector<Past> past_;       // the newest steps of this motion: those that a window may still begin with
    std::size_t room_ = kKept;     // how many of them there may be before the oldest are dropped
    std::size_t speed_first_ = 0;  // where the windows begin that end with the newest step
    std::size_t late_first_ = 0;
    int direction_ = 0;
    bool measured_ = false;  // a whole window of this stretch
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

/// The later window ends with the newest step, the earlier one with the later one's first.
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

/// Whether the steps from `first` to the newest make a window.
inline bool SpeedMeter::is_wide(std::size_t first, Ticks least) const {
    return past_.size() > first + kLeastSteps && past_.back().tick - past_[first].tick >= least;
}

/// Moves the window's first step as late as it may be. False: there is no window yet.
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
