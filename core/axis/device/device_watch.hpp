// Whether what is read of a device can be the device: by what it showed before, what it was ordered, and how long this
// process has been looking. A device that cannot be is lost to its axis.
#pragma once

#include <optional>
#include <string>

#include "core/axis/device/device.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// Of one device, from when it was found.
class DeviceWatch {
public:
    explicit DeviceWatch(const MachineConfig& machine);

    /// What it was ordered, in its own time.
    void take(const DeviceOrder& order);

    /// Each loop, when this process's clock reads `own`: what cannot be, with what was read. Nothing: all is well.
    std::optional<std::string> doubt_of(Tick own, const DeviceStatus& status);

    /// How long a device may show the same tick, or not end a run whose frames are over, before it is given up: as
    /// long as any other part of the machine may be silent. It may be a process, which stalls as others do. Only time
    /// in which this process ran counts, a slot at most for each loop.
    Ticks patience() const { return patience_; }

private:
    std::optional<std::string> contradiction(const DeviceStatus& status) const;
    bool is_overdue(const DeviceStatus& status) const;

    Ticks slot_;
    Ticks patience_;
    std::optional<DeviceStatus> last_;
    Tick looked_;             // by this process's clock
    Ticks stood_;             // its clock, while this process looked
    Ticks overdue_;           // its run, likewise
    std::uint64_t run_ = 0;   // ordered last; 0: none yet
    FrameNumber loaded_ = 0;  // of it
    Tick ends_;               // its frames, tails included, by the device's clock
};

}  // namespace lockstep
