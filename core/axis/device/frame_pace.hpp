// How many ticks of the device's clock frames last that follow each other.
//
// Frames are commanded in machine time. By the device's clock each should end where its end is by what is known of the
// clocks when it is loaded; that changes from frame to frame, and what it has changed is a correction to be made. A
// rate that changed at once would be a sudden change of speed, so the rate (device ticks per machine tick) is
// continuous: it changes evenly within a frame, by no more than the axis's acceleration has to spare, to
//
//     the clocks' rate + error / settling time,   at most kMaxSlew from the clocks' rate,
//
// where the error is what is left at that frame's end. So errors decay without overshoot. Ends are rounded to ticks;
// the parts of a tick are kept, so that rounding changes no rate.
#pragma once

#include "core/axis/device/retime.hpp"
#include "core/clock/machine_time.hpp"
#include "core/machine.hpp"

namespace lockstep {

class FramePace {
public:
    /// The rate's greatest distance from 1: the clocks' own, and a correction's.
    static constexpr double kMaxOff = ClockEstimator::kMaxRate + MachineTime::kMaxSlew;

    /// `frame`: how long frames last.
    FramePace(Ticks frame, const AxisLimits& limits);

    /// The next stretch begins here. `clocks`: device ticks per machine tick, minus 1.
    void begin(Tick start, double clocks);

    struct Stretch {
        Ticks lasts;             // machine time
        std::size_t pieces = 1;  // at least a tick for each
        Tick asked_end;          // by the device's clock
        double clocks = 0;       // as in begin
    };
    /// The next frame's body, which the following one goes on from.
    Retiming body(const Stretch& stretch);
    /// The way to rest from there. Nothing follows it, so all that can be made up for is.
    Retiming tail(const Stretch& stretch) const;
    /// The next stretch keeps the device's ticks.
    void keep(Ticks ticks) { end_ += ticks; }

    Tick end() const { return end_; }

private:
    double rate_at_end(const Stretch& stretch, bool settles) const;
    Retiming retiming(const Stretch& stretch, double rate_at_end) const;

    double frame_;
    double most_change_;  // of the rate, in a tick
    Tick end_;            // of the last body
    double beyond_ = 0;   // of a tick: where it would have ended
    double rate_ = 1;     // there
};

}  // namespace lockstep
