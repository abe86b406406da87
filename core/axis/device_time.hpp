// Converts between the controller, which uses machine time, and the device, which counts ticks of its own clock.
//
// If machine time is shared, or kept by PTP, both are the same number and everything passes unchanged. Over the network
// there are three clocks: the coordinator's (machine time), this process's, and the device's. The coordinator's clock
// is estimated from message exchanges, the device's from looks at the device. Their rates and offsets may change at any
// time. So each frame's end is mapped when the frame is loaded, and its start is where the frame before ended. A change
// of the estimates between two loads is corrected within the axis's limits (core/axis/device/frame_pace.hpp). The part
// not corrected yet counts as error.
//
// An axis's own moves are not coordinated. They keep the device's ticks, so that each step is made at exactly the tick
// of its method. Only their start is mapped. Steps and tracks are recorded in the device's time, together with their
// machine time.
#pragma once

#include <deque>
#include <optional>

#include "core/axis/axis_controller.hpp"
#include "core/axis/device/device.hpp"
#include "core/axis/device/frame_pace.hpp"
#include "core/clock/machine_time.hpp"

namespace lockstep {

class DeviceTime {
public:
    /// `axis`: its place in the configuration.
    DeviceTime(std::size_t axis, const MachineConfig& machine);

    /// Takes an exchange with the coordinator, by this process's clock.
    void take(const ClockExchange& exchange) { machine_.take(exchange); }

    struct Device {
        Tick now;                   // the tick that it shows
        bool shares_clock = false;  // it counts the ticks of this process's clock, but may show them late
    };
    /// Call it in each loop. `own`: the reading of this process's clock. `in_use`: the axis moves, so machine time is
    /// slewed and not set. Returns false while machine time is not known yet. Also returns false for one loop if this
    /// process's clock disagrees with the device's. No one can set the device's clock, so it shows by how much this
    /// process's clock was set. A device's clock that stands still proves nothing. If it does so for long, the device
    /// is given up (core/axis/device/device_watch.hpp). Until then its axis still publishes.
    bool look(Tick own, const Device& device, bool in_use);

    /// From the next look on the clock is that of another device.
    void change_device() { changed_ = true; }

    /// Machine time at the last look. All members below refer to that look, too.
    Tick now() const { return now_; }
    /// Bound on the error of `now` and of the bodies that the device holds and has not finished. Tails do not count. A
    /// tail is run only if a next body is missing, and may be long. The error of its end is recorded with its track,
    /// and is no reason to stop.
    Ticks error() const;
    /// Converts the device's clock to machine time as the exchanges determine it, for the record. Motion uses `now`,
    /// which is slewed towards that time.
    ClockView device_clock() const;

    DeviceStatus in_machine_time(DeviceStatus status) const;
    /// Call it for all orders in the order in which the device gets them. A frame that does not fit the device's
    /// segments stays unchanged, and the device refuses it.
    DeviceOrder in_device_time(DeviceOrder order);
    /// Returns the track as the device was given it. Call it for tracks of the run in progress, before the next run
    /// begins, in the order in which they were run. Frames before the track's frame are forgotten.
    ExecutedTrack in_device_time(ExecutedTrack track);

private:
    struct Loaded {
        device::LoadFrame frame;  // as the device was given it
        Tick body_end;
        Tick end;
        Ticks error;  // the error of the frame's whole body
        Ticks tail_error;
    };

    bool certain(Tick own, Tick shown);
    void own_was_set(Tick own, Tick shown);
    Tick to_device(Tick machine) const { return shown_.at(machine_.own_at(machine)).other; }
    Tick to_machine(Tick device) const;
    Ticks error_at(Tick machine) const;
    void load(device::LoadFrame& frame);
    void pace(device::LoadFrame& frame, Tick machine_end, Loaded& loaded);
    template <typename Pieces>
    FramePace::Part part_of(const Pieces& pieces, Tick machine_end) const;
    double clocks() const { return 1 / (1 + device_clock().rate) - 1; }

    std::int64_t tick_ns_;
    TimeSource source_;
    Ticks ptp_error_;
    MachineTime machine_;
    ClockEstimator shown_;      // the device's clock
    bool changed_ = false;      // the next look is at another device
    Tick own_;                  // this process's clock at the last look without doubt
    Tick seen_;                 // the device's clock at that look
    bool stood_still_ = false;  // the device's clock stood still at a look since
    Tick now_;
    Tick device_;

    bool own_run_ = false;
    std::optional<Tick> machine_end_;  // end of the frame loaded last in this run
    FramePace pace_;
    Ticks end_error_;            // error of that end
    std::deque<Loaded> loaded_;  // frames loaded and not yet recorded
};

}  // namespace lockstep
