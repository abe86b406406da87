// How fast steps come, and how fast that changes, from nothing but the ticks they fall on.
//
// A step's tick is a whole number, so the interval between two steps is off by up to a tick; between neighbours that
// may be a large part of it. Both figures are therefore taken over windows of several steps:
//   speed         n steps of one direction / the ticks they took, over the latest window of at least 8 steps and
//                 1 000 ticks. A tick's rounding is then at most 0.1 %. The true speed is met at some instant within
//                 the window; a peak shorter than the window is flattened.
//   acceleration  (speed in one window - speed in the window before) / the time between their middles, windows of at
//                 least 8 steps and 10 000 ticks. Rounding then is at most 2e-8 of the speed, per tick. A permitted
//                 jump of speed inside a window counts as acceleration spread over it.
// A stretch from rest to rest, or from turn to turn, that is shorter than a window counts as one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "clients/analysis/course.hpp"
#include "core/step/segment.hpp"

namespace lockstep::analysis {

class SpeedMeter {
public:
    /// Without a step for so long an axis is at rest; the window starts anew.
    static constexpr Ticks kRest{100'000};

    SpeedMeter();

    /// Takes the next step, in order. The speed in the window it completes, at the window's middle, signed.
    std::optional<Sample> step(StepEdge edge);
    /// The acceleration between the two windows that the latest step completed, signed; none: it completed none.
    const std::optional<Sample>& acceleration() const { return acceleration_; }
    /// The steps to come do not join those before. Also the end of the last stretch.
    void interrupt();

    double peak_steps_per_tick() const { return peak_speed_; }          // either way
    double peak_steps_per_tick2() const { return peak_acceleration_; }  // speeding up or slowing down

private:
    /// A window's first and last step, by number.
    struct Window {
        std::int64_t first = 0;
        std::int64_t last = 0;
    };

    std::int64_t tick(std::int64_t number) const;
    bool is_wide(Window window, Ticks least) const;
    void narrow(Window& window, Ticks least) const;
    double speed(Window window) const;
    double middle(Window window) const;
    std::optional<Sample> measure_speed();
    void measure_acceleration();

    std::vector<std::int64_t> ring_;  // ticks of the newest steps of this stretch
    std::int64_t newest_ = -1;        // its number, from 0 in each stretch
    int direction_ = 0;
    bool measured_ = false;  // a whole window of this stretch
    Window speed_window_;
    Window late_;  // the two windows of the acceleration
    Window early_;
    std::optional<Sample> acceleration_;
    double peak_speed_ = 0;
    double peak_acceleration_ = 0;
};

}  // namespace lockstep::analysis
