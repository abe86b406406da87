// Decides how many ticks of the device's clock each frame of a run lasts.
//
// Frames are commanded in machine time. The end of each is mapped to the device's clock by the estimates of the clocks
// at the time at which the frame is loaded. The estimates change from frame to frame, and each change leaves an error
// to correct. A sudden change of the rate (device ticks per machine tick) would be a sudden change of speed, so the
// rate is continuous. It changes evenly within a frame, by no more than the axis's spare acceleration allows, to
//
//     the clocks' rate + error / settling time,   at most kMaxSlew from the clocks' rate,
//
// where the error is what remains at that frame's end. So errors decay without overshoot. Ends are rounded to ticks.
// The fractions of a tick are kept, so that rounding changes no rate.
#pragma once

#include "core/axis/device/retime.hpp"
#include "core/clock/machine_time.hpp"
#include "core/machine.hpp"

namespace lockstep {

class FramePace {
public:
    /// The greatest distance of the rate from 1: the clocks' own difference plus a correction.
    static constexpr double kMaxOff = ClockEstimator::kMaxRate + MachineTime::kMaxSlew;

    /// `frame`: how long frames last.
    FramePace(Ticks frame, const AxisLimits& limits);

    /// The next part begins here. `clocks`: device ticks per machine tick, minus 1.
    void begin(Tick start, double clocks);

    struct Part {
        Ticks lasts;             // machine time
        std::size_t pieces = 1;  // the part has at least a tick for each
        Tick asked_end;          // the wanted end by the device's clock
        double clocks = 0;       // as in begin
    };
    /// Decides the next frame's body. The following frame continues from its end.
    Retiming body(const Part& part);
    /// Decides the tail behind the last body. No frame follows a tail, so it corrects as much of the error as the
    /// limits allow.
    Retiming tail(const Part& part) const;
    /// The next part keeps the device's ticks.
    void keep(Ticks ticks) { end_ += ticks; }

    Tick end() const { return end_; }

private:
    double rate_at_end(const Part& part, bool settles) const;
    Retiming retiming(const Part& part, double rate_at_end) const;

    double frame_;
    double most_change_;  // greatest change of the rate in a tick
    Tick end_;            // end of the last body
    double beyond_ = 0;   // fraction of a tick from end_ to its exact end
    double rate_ = 1;     // the rate at that end
};

}  // namespace lockstep
