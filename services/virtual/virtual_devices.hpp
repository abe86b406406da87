// The devices of a virtual machine's axes, and their faults. The devices outlive the axes' processes.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "services/axis/axis_node.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/virtual_fault.hpp"

namespace lockstep {

class VirtualDevices {
public:
    /// Powers up all devices at `now`. `clocks` must outlive this object.
    VirtualDevices(const MachineConfig& machine, const MachineClocks& clocks, std::uint64_t seed, Tick now);

    SimulatedDevice& operator[](std::size_t axis) { return *devices_[axis].device.simulated; }
    const SimulatedDevice& operator[](std::size_t axis) const { return *devices_[axis].device.simulated; }

    /// Opens the device for its axis. Error: no process holds its registers.
    std::expected<AxisDevice, std::string> open(std::size_t axis) const;
    void advance(std::size_t axis, Tick now);

    /// Begins or ends a fault of an axis's slide, switches or device. The device runs up to `now` before and reads its
    /// inputs after it.
    void begin(const VirtualFault& fault, Tick now) { apply(fault, true, now); }
    void end(const VirtualFault& fault, Tick now) { apply(fault, false, now); }

private:
    struct Device {
        AxisDevice device;
        bool is_stopped = false;
        bool is_gone = false;
    };
    void apply(const VirtualFault& fault, bool begins, Tick now);
    void disturb(const VirtualFault& fault, bool begins);
    void strike(const VirtualFault& fault, bool begins, Tick now);
    void power_up_again(std::size_t axis, RegisterWindow window, Tick now);
    void overwrite(std::size_t axis, bool garbage, Tick now);

    const MachineClocks& clocks_;
    std::int64_t tick_ns_;
    std::uint64_t seed_;
    std::vector<Device> devices_;
};

}  // namespace lockstep
