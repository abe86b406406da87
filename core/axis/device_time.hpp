// Between the controller, which thinks in machine time, and the device, which counts ticks of its own clock.
//
// Where machine time is shared, or kept by PTP, the two are one number, and everything passes through unchanged. Over
// the network there are three clocks: the coordinator's (machine time), this process's, and the device's. The first is
// estimated from exchanges of messages, the last from looks at the device; their rates and offsets may change at any
// time, so each frame's end is mapped again when the frame is loaded, and its start is where the frame before ended.
// What has changed between two loads is made up for within the axis's limits (core/axis/device/frame_pace.hpp); what is
// left counts as error until then.
//
// An axis's own moves are not coordinated: they keep the device's ticks, so that each step is made at its method's own
// tick; only their start is mapped. What is recorded of motion (steps, tracks) is in the device's time, with what it is
// in machine time beside it.
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

    /// An exchange with the coordinator, by this process's clock.
    void take(const ClockExchange& exchange) { machine_.take(exchange); }

    struct Device {
        Tick now;                   // what it shows
        bool shares_clock = false;  // it counts the ticks of this process's clock, though it may show them late
    };
    /// Each loop, when this process's clock reads `own`. False: the machine time is not known yet; or, for one loop, it
    /// is in doubt: this process's clock does not go by the device's, which nobody can set. If it was set, the device's
    /// tells by how much. A device's clock that stands still proves nothing: if it does so for long, the device is
    /// given up (core/axis/device/device_watch.hpp), and until then its axis is not silent. `in_use`: the axis moves,
    /// its time is slewed and not set.
    bool look(Tick own, const Device& device, bool in_use);

    /// What is looked at from the next look on is another device's clock.
    void change_device() { changed_ = true; }

    /// At the last look, as all below.
    Tick now() const { return now_; }
    /// How far `now` may be off, and the bodies loaded into the device and not yet made. A tail is for when these fail,
    /// and may be long: how far its end is off is said with its track, and no reason to stop.
    Ticks error() const;
    /// The device's clock in machine time, as the exchanges have it: for the record. Motion goes by `now`, which is
    /// slewed towards it.
    ClockView device_clock() const;

    DeviceStatus in_machine_time(DeviceStatus status) const;
    /// In the order in which they are to be given. A frame that does not fit the device's segments is left as it is,
    /// and refused by the device.
    DeviceOrder in_device_time(DeviceOrder order);
    /// As the device was given it: of the run in progress, before the next is begun. Tracks come in the order in which
    /// they were run; the frames before it are forgotten.
    ExecutedTrack in_device_time(ExecutedTrack track);

private:
    struct Loaded {
        device::LoadFrame frame;  // as the device has it
        Tick body_end;
        Tick end;
        Ticks error;  // of its body, from end to end
        Ticks tail_error;
    };

    bool certain(Tick own, Tick shown);
    void own_was_set(Tick own, Tick shown);
    Tick to_device(Tick machine) const { return shown_.at(machine_.own_at(machine)).other; }
    Tick to_machine(Tick device) const;
    Ticks error_at(Tick machine) const;
    void load(device::LoadFrame& frame);
    void stretch(device::LoadFrame& frame, Tick machine_end, Loaded& loaded);
    template <typename Pieces>
    FramePace::Stretch stretch_of(const Pieces& pieces, Tick machine_end) const;
    double clocks() const { return 1 / (1 + device_clock().rate) - 1; }

    std::int64_t tick_ns_;
    TimeSource source_;
    Ticks ptp_error_;
    MachineTime machine_;
    ClockEstimator shown_;      // by the device
    bool changed_ = false;      // it is another's
    Tick own_;                  // this process's clock, at the last look without doubt
    Tick seen_;                 // the device's, then
    bool stood_still_ = false;  // the device's, at a look since
    Tick now_;
    Tick device_;

    bool own_run_ = false;
    std::optional<Tick> machine_end_;  // of the frame loaded last in this run
    FramePace pace_;
    Ticks end_error_;            // of its end as the other
    std::deque<Loaded> loaded_;  // and not yet recorded
};

}  // namespace lockstep
