// Checks whether a reading of a device is possible, given its earlier readings, its orders, and the time for which this
// process has watched it. If a reading is impossible, the axis treats the device as lost.
#pragma once

#include <optional>
#include <string>

#include "core/axis/device/device.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// Watches one device from the time at which it was found.
class DeviceWatch {
public:
    explicit DeviceWatch(const MachineConfig& machine);

    /// Takes an order to the device, in the device's time.
    void take(const DeviceOrder& order);

    /// Call it in each loop. `own`: the reading of this process's clock. Returns what is impossible about the status,
    /// with the values read, or nullopt if nothing is.
    std::optional<std::string> doubt_of(Tick own, const DeviceStatus& status);

    /// Call it instead in loops in which a device that was found has not answered yet.
    std::optional<std::string> doubt_of_silence(Tick own);

    /// How long a device may show the same tick, or not end a run after the end of its frames, before it is given up.
    /// It is as long as for a silent process, because a device may be a process that stalls. Only time in which this
    /// process ran counts, at most a slot for each loop.
    Ticks patience() const { return patience_; }

private:
    Ticks pass_until(Tick own);
    std::optional<std::string> contradiction(const DeviceStatus& status) const;
    bool is_overdue(const DeviceStatus& status) const;

    Ticks slot_;
    Ticks patience_;
    std::optional<DeviceStatus> last_;
    std::optional<Tick> looked_;  // the last look, by this process's clock
    Ticks stood_;                 // how long the device's clock has stood still while this process looked
    Ticks overdue_;               // how long the device's run has been overdue while this process looked
    std::uint64_t run_ = 0;       // the run ordered last; 0: none yet
    FrameNumber loaded_ = 0;      // the last frame of that run that was loaded
    Tick ends_;                   // the end of that run's frames, tails included, by the device's clock
};

}  // namespace lockstep
