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

    /// The window of acceleration that ends with a step.
    struct Window {
        Tick from;
        double speed = 0;
    };

    bool narrow(std::size_t& first, Ticks least) const;
    double speed_since(std::size_t first) const;
    double least_speed_since(std::size_t first) const;
    std::optional<Sample> measure_speed();
    void measure_acceleration();
    void begin_stretch(StepEdge edge, bool rested);
    void forget();

    static double middle(Tick from, Tick to) {
        return static_cast<double>(from.value) / 2 + static_cast<double>(to.value) / 2;
    }

    std::vector<Tick> past_;       // the newest steps of this motion, with which a window may still begin
    std::vector<Window> windows_;  // of these steps; as many last ones as have one
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
    const bool rested = !past_.empty() && edge.tick - past_.back() > kRest;
    if (rested || edge.direction != direction_) { begin_stretch(edge, rested); }
    if (past_.size() == room_) { forget(); }
    past_.push_back(edge.tick);
    measure_acceleration();
    return measure_speed();
}

inline std::optional<Sample> SpeedMeter::measure_speed() {
    if (!narrow(speed_first_, kSpeedWindow)) { return std::nullopt; }
    measured_ = true;
    const double speed = speed_since(speed_first_);
    peak_speed_ = std::max(peak_speed_, speed);
    const Tick first = past_[speed_first_];
    return Sample{first + Ticks{(past_.back() - first).value / 2}, direction_ * speed};
}

/// The later window ends with the newest step. The earlier window ends with the first step of the later one.
inline void SpeedMeter::measure_acceleration() {
    acceleration_.reset();
    if (!narrow(late_first_, kAccelerationWindow)) { return; }
    const Tick newest = past_.back();
    const Tick between = past_[late_first_];
    const Window& late = windows_.emplace_back(between, speed_since(late_first_));
    const std::size_t behind = past_.size() - late_first_;  // how many windows end with the step between or later
    if (windows_.size() < behind) { return; }
    const Window& early = windows_[windows_.size() - behind];
    const double time = middle(late.from, newest) - middle(early.from, between);
    const double acceleration = (late.speed - early.speed) / time;
    acceleration_ = Sample{between, direction_ * acceleration};
    peak_acceleration_ = std::max(peak_acceleration_, std::abs(acceleration));
}

/// Moves the window's first step as late as possible. Returns false if there is no window yet.
inline bool SpeedMeter::narrow(std::size_t& first, Ticks least) const {
    if (past_.size() <= kLeastSteps) { return false; }
    const std::size_t most = past_.size() - 1 - kLeastSteps;  // the latest step with which a window may begin
    const Tick latest = past_.back() - least;
    if (first > most || past_[first] > latest) { return false; }
    while (first < most && past_[first + 1] <= latest) { ++first; }
    return true;
}

inline double SpeedMeter::speed_since(std::size_t first) const {
    return static_cast<double>(past_.size() - 1 - first) / static_cast<double>((past_.back() - past_[first]).value);
}

inline double SpeedMeter::least_speed_since(std::size_t first) const {
    return static_cast<double>(past_.size() - 1 - first) / static_cast<double>((past_.back() - past_[first]).value + 1);
}

}  // namespace lockstep::analysis
