// The clock of each process and device of a virtual machine.
#pragma once

#include <vector>

#include "services/virtual/virtual_clock.hpp"

namespace lockstep {

class MachineClocks {
public:
    /// `start` is the true time at which all clocks were switched on. Axes without an entry in `clocks` read the true
    /// time.
    MachineClocks(std::vector<AxisClocks> clocks, Tick start) : clocks_(std::move(clocks)), start_(start) {}

    /// The coordinator's clock.
    Tick machine(Tick now) const { return now - booted_; }
    Tick process(std::size_t axis, Tick now) const { return of(axis).process.at(now, start_); }
    Tick device(std::size_t axis, Tick now) const { return of(axis).device.at(now, start_); }

    void set_process(std::size_t axis, Ticks forward) {
        if (clocks_.size() <= axis) { clocks_.resize(axis + 1); }
        clocks_[axis].process.offset += forward;
    }
    /// Restarts the coordinator's clock.
    void reboot(Tick now) { booted_ = now - start_; }

private:
    AxisClocks of(std::size_t axis) const { return axis < clocks_.size() ? clocks_[axis] : AxisClocks{}; }

    std::vector<AxisClocks> clocks_;
    Tick start_;
    Ticks booted_;  // the true time minus the coordinator's clock
};

}  // namespace lockstep
