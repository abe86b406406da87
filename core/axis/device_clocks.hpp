// The clocks of an axis: machine time, this process's clock, and the clock of its device.
//
// If machine time is shared, or kept by PTP, the first two are the same, and if the device counts the host's clock, the
// last two. Otherwise the coordinator's clock is estimated from message exchanges, and the device's from its readings,
// which are such exchanges too. Their rates and offsets may change at any time.
#pragma once

#include <optional>

#include "core/axis/device/device_reading.hpp"
#include "core/clock/machine_time.hpp"
#include "core/machine.hpp"

namespace lockstep {

class DeviceClocks {
public:
    explicit DeviceClocks(const MachineConfig& machine);

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

    /// Machine time at the last look. All functions below refer to that look, too.
    Tick now() const { return now_; }
    /// The tick that the device showed last.
    Tick device() const { return device_; }
    /// Converts the device's clock to machine time as the exchanges determine it, for the record. Motion uses `now`,
    /// which is slewed towards that time.
    ClockView device_clock() const;
    /// By how much the device's clock is faster than machine time, as a share.
    double device_rate() const { return 1 / (1 + device_clock().rate) - 1; }
    /// All clocks are the same.
    bool is_one_clock() const { return machine_.is_own_clock() && clock_ == DeviceClock::Host; }
    Tick to_device(Tick machine) const { return shown_at(machine_.own_at(machine)).other; }
    Tick to_machine(Tick device) const;
    /// Bound on the error of a tick of the device for this machine time.
    Ticks error_at(Tick machine) const;
    /// Bound on the error of machine time alone.
    Ticks machine_error() const { return machine_.error(own_); }

private:
    bool certain(const ClockExchange& reading);
    void own_was_set(Tick own, Tick shown, Ticks within);
    ClockView shown_at(Tick own) const {
        return clock_ == DeviceClock::Own ? shown_.view(own) : ClockView{.own = own, .other = own};
    }

    std::int64_t tick_ns_;
    MachineTime machine_;
    DeviceClock clock_ = DeviceClock::Host;
    ClockEstimator shown_;  // the device's own clock
    bool changed_ = false;  // the next reading is that of another device
    /// A reading without doubt, the one that bounds both clocks best now.
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
};

}  // namespace lockstep
