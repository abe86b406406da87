// The clock of each process and device of a virtual machine.
#pragma once

#include <vector>

#include "core/indices.hpp"
#include "services/virtual/virtual_clock.hpp"

namespace lockstep {

class MachineClocks {
public:
    /// `start` is the true time at which all clocks were switched on. Axes without an entry in `clocks` read the true
    /// time.
    MachineClocks(std::vector<AxisClocks> clocks, Tick start) : clocks_(std::move(clocks)), start_(start) {}

    /// The coordinator's clock.
    Tick machine(Tick now) const { return now - booted_; }
    Tick process(MotorIndex motor, Tick now) const { return of(motor).process.at(now, start_); }
    Tick device(MotorIndex motor, Tick now) const { return of(motor).device.at(now, start_); }

    void set_process(MotorIndex motor, Ticks forward) {
        if (clocks_.size() <= motor) { clocks_.resize(motor + 1); }
        clocks_[motor].process.offset += forward;
    }
    /// Restarts the coordinator's clock.
    void reboot(Tick now) { booted_ = now - start_; }

private:
    AxisClocks of(MotorIndex motor) const { return motor < clocks_.size() ? clocks_[motor] : AxisClocks{}; }

    std::vector<AxisClocks> clocks_;
    Tick start_;
    Ticks booted_;  // the true time minus the coordinator's clock
};

}  // namespace lockstep
