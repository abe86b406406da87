// The devices of a virtual machine's axes, and their faults. The devices outlive the axes' processes.
#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/axis/axis_node.hpp"
#include "services/axis/window_port.hpp"
#include "services/virtual/late_link.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/virtual_fault.hpp"
#include "services/virtual/virtual_options.hpp"
#include "sim_fpga/contacts/slide_contacts.hpp"

namespace lockstep {

class VirtualDevices {
public:
    /// Powers up all devices at `now`. `clocks` must outlive this object.
    VirtualDevices(const VirtualOptions& options, const MachineClocks& clocks, Tick now);

    SimulatedDevice& operator[](MotorIndex motor) { return *devices_[motor].simulated; }
    const SimulatedDevice& operator[](MotorIndex motor) const { return *devices_[motor].simulated; }
    /// Its registers, as the host and the device see them.
    const RegisterWindow& registers(MotorIndex motor) const { return devices_[motor].window; }

    /// Opens the device for its axis. Errors: no process holds its registers, or they are not those of a device.
    std::expected<std::unique_ptr<DevicePort>, std::string> open(MotorIndex motor);
    /// Call it before the axis uses its device at `now`, and after that.
    void advance(MotorIndex motor, Tick now);

    /// Begins or ends a fault of an axis's slide, switches or device. The device runs up to `now` before and reads its
    /// inputs after it.
    void begin(const VirtualFault& fault, Tick now) { apply(fault, true, now); }
    void end(const VirtualFault& fault, Tick now) { apply(fault, false, now); }
    /// Closes or opens an input of the machine, by its number there.
    void set_input(std::size_t input, bool closed, Tick now);
    /// The switches of axes, and the inputs of probes that touch the workpiece, follow the slides to 16 ticks.
    void follow_switches(Tick now);

private:
    struct Device {
        DeviceAbilities abilities;
        RegisterWindow window;
        std::unique_ptr<SimulatedDevice> simulated;
        std::optional<LateLink> link;
        Tick now;                       // the true time
        std::optional<Tick> next_step;  // in its own time; nullopt: not known
        bool is_stopped = false;
        bool is_gone = false;
    };
    void deliver(MotorIndex motor, Tick now);
    bool may_have_stepped(Tick now) const;
    void note_next_steps(Tick until);
    void follow_switches_at(Tick now);
    void power_up(MotorIndex motor, const RegisterWindow& window, Plant plant, Tick now);
    void apply(const VirtualFault& fault, bool begins, Tick now);
    void disturb(const VirtualFault& fault, bool begins);
    void strike(const VirtualFault& fault, bool begins, Tick now);
    void overwrite(MotorIndex motor, bool garbage, Tick now);

    const MachineClocks& clocks_;
    MachineConfig machine_;
    std::vector<MotorConfig> motors_;
    std::uint64_t seed_;
    std::vector<Device> devices_;
    SlideContacts contacts_;
    Tick followed_;  // by the contacts
};

}  // namespace lockstep
