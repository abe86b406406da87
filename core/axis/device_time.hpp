// Converts between the controller, which uses machine time, and the device, which counts ticks of its own clock.
//
// There are three clocks: the coordinator's (machine time), this process's, and the device's. If machine time is
// shared, or kept by PTP, the first two are the same, and if the device counts the host's clock, the last two. If all
// are the same, everything passes unchanged. Otherwise the coordinator's clock is estimated from message exchanges, and
// the device's from its readings, which are such exchanges too. Their rates and offsets may change at any time. So each
// frame's end is mapped when the frame is loaded, and its start is where the frame before ended. A change of the
// estimates between two loads is corrected within the axis's limits (core/axis/device/frame_pace.hpp). The part not
// corrected yet counts as error.
//
// An axis's own moves are not coordinated. They keep the device's ticks, so that each step is made at exactly the tick
// of its method. Only their start is mapped. Steps and tracks are recorded in the device's time, together with their
// machine time.
#pragma once

#include <deque>
#include <optional>

#include "core/axis/axis_controller.hpp"
#include "core/axis/device/device.hpp"
#include "core/axis/device/device_reading.hpp"
#include "core/axis/device/frame_pace.hpp"
#include "core/clock/machine_time.hpp"

namespace lockstep {

class DeviceTime {
public:
    /// `axis`: its place in the configuration.
    DeviceTime(std::size_t axis, const MachineConfig& machine);

    /// Takes an exchange with the coordinator, by this process's clock.
    void take(const ClockExchange& exchange) { machine_.take(exchange); }

    /// The device's clock in one loop. The clock of a lost device counts until another is found: what the lost one has
    /// run is still converted by it.
    struct Device {
        DeviceClock clock = DeviceClock::Host;
        std::optional<ClockExchange> reading;  // none: there is no new one since the last loop
    };
    /// Call it in each loop. `own`: the reading of this process's clock. `in_use`: the axis moves, so machine time is
    /// slewed and not set. Returns false while machine time or the device's own clock is not known yet. Also returns
    /// false for one loop if this process's clock disagrees with the device's own. No one can set the device's clock,
    /// so it shows by how much this process's clock was set. A device's clock that stands still proves nothing. If it
    /// does so for long, the device is given up (core/axis/device/device_watch.hpp). Until then its axis still
    /// publishes.
    bool look(Tick own, const std::optional<Device>& device, bool in_use);

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
    struct Paced {
        Ticks machine;
        Retiming when;
    };
    struct Loaded {
        device::LoadFrame frame;  // as the device was given it
        Paced body;
        Paced tail;
        Tick body_end;
        Tick end;
        Ticks error;  // the error of the frame's whole body
        Ticks tail_error;
    };

    bool certain(const ClockExchange& reading);
    void own_was_set(Tick own, Tick shown, Ticks within);
    /// All clocks are the same.
    bool is_one_clock() const { return machine_.is_own_clock() && clock_ == DeviceClock::Host; }
    ClockView shown_at(Tick own) const {
        return clock_ == DeviceClock::Own ? shown_.view(own) : ClockView{.own = own, .other = own};
    }
    Tick to_device(Tick machine) const { return shown_at(machine_.own_at(machine)).other; }
    Tick to_machine(Tick device) const;
    Ticks error_at(Tick machine) const;
    void load(device::LoadFrame& frame);
    void load(device::LoadOutputs& outputs) const;
    void pace(device::LoadFrame& frame, Tick machine_end, Loaded& loaded);
    template <typename Pieces>
    FramePace::Part part_of(const Pieces& pieces, Tick machine_end) const;
    double clocks() const { return 1 / (1 + device_clock().rate) - 1; }

    std::int64_t tick_ns_;
    MachineTime machine_;
    DeviceClock clock_ = DeviceClock::Host;
    ClockEstimator shown_;  // the device's own clock
    bool changed_ = false;  // the next reading is that of another device
    /// A reading without doubt, the one that tells most about both clocks now.
    struct Agreed {
        Tick own;      // the middle of its interval
        Ticks within;  // of this process's clock
        Tick shown;
    };
    Agreed agreed_;
    bool stood_still_ = false;  // the device's clock stood still at a look since
    Tick own_;                  // at the last look
    Tick now_;
    Tick device_;  // the tick that the device showed last

    bool own_run_ = false;
    std::optional<Tick> machine_end_;  // end of the frame loaded last in this run
    FramePace pace_;
    Ticks end_error_;            // error of that end
    std::deque<Loaded> loaded_;  // frames loaded and not yet recorded
};

}  // namespace lockstep
