#include "services/virtual/virtual_devices.hpp"

#include <random>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

/// Starts the frame's first piece a tick late, so the frame does not join the one before.
void damage_newest_frame(RegisterWindow& window) {
    using namespace registers;
    const std::uint64_t head = window.load(kSegmentHead);
    const auto place = [](std::uint64_t n) {
        return kSegmentRing + (n % kSegmentRingEntries) * kSegmentRingEntryBytes;
    };
    for (std::uint64_t n = head; n != window.load(kSegmentTail); --n) {
        const std::size_t entry = place(n - 1);
        if ((window.load(entry + kSegmentRingFlags) & kSegmentRingFlagsFirst) == 0) { continue; }
        return window.store(entry + kSegmentRingStart, window.load(entry + kSegmentRingStart) + 1);
    }
}

/// Makes the frame's last piece two steps longer, so the frame joins the one before but ends elsewhere.
void mislead_newest_frame(RegisterWindow& window) {
    using namespace registers;
    const std::uint64_t newest = window.load(kSegmentHead) - 1;
    const std::size_t entry = kSegmentRing + (newest % kSegmentRingEntries) * kSegmentRingEntryBytes;
    const auto ticks = static_cast<double>(window.load(entry + kSegmentRingTicks));
    const auto more = static_cast<std::uint64_t>(2 / ticks * 0x1p64);
    window.store(entry + kSegmentRingVelocity, window.load(entry + kSegmentRingVelocity) + more);
}

}  // namespace

VirtualDevices::VirtualDevices(const MachineConfig& machine, const MachineClocks& clocks, std::uint64_t seed, Tick now)
    : clocks_(clocks), tick_ns_(machine.tick_ns), seed_(seed) {
    const std::vector<MotorConfig> motors = motors_of(machine);
    for (std::size_t i = 0; i < motors.size(); ++i) {
        devices_.push_back({.device = simulated_device(motors[i], tick_ns_, clocks.device(i, now))});
    }
}

std::expected<AxisDevice, std::string> VirtualDevices::open(std::size_t axis) const {
    if (devices_[axis].is_gone) { return std::unexpected("no process holds its registers"); }
    return AxisDevice{devices_[axis].device.window, nullptr};
}

void VirtualDevices::advance(std::size_t axis, Tick now) {
    if (!devices_[axis].is_stopped) { (*this)[axis].advance(clocks_.device(axis, now)); }
}

void VirtualDevices::apply(const VirtualFault& fault, bool begins, Tick now) {
    advance(fault.process, now);
    fault.is_of_device() ? strike(fault, begins, now) : disturb(fault, begins);
    advance(fault.process, now);
}

void VirtualDevices::disturb(const VirtualFault& fault, bool begins) {
    const std::size_t i = fault.process;
    if (fault.kind == VirtualFault::Kind::Stick) {
        (*this)[i].plant().stick(fault.contact, begins ? std::optional(fault.closed) : std::nullopt);
    } else if (fault.kind == VirtualFault::Kind::Push && begins) {
        (*this)[i].plant().push(fault.push_steps);
    } else if (begins) {
        RegisterWindow& window = devices_[i].device.window;
        fault.ends_elsewhere ? mislead_newest_frame(window) : damage_newest_frame(window);
    }
}

void VirtualDevices::strike(const VirtualFault& fault, bool begins, Tick now) {
    using Kind = VirtualFault::Kind;
    Device& device = devices_[fault.process];
    device.is_stopped = begins && fault.kind != Kind::Overwrite;
    device.is_gone = begins && fault.kind == Kind::KillDevice;
    if (fault.kind == Kind::Overwrite) {
        begins ? overwrite(fault.process, fault.garbage, now)
               : power_up_again(fault.process, device.device.window, now);
    } else if (fault.kind == Kind::KillDevice && !begins) {
        power_up_again(fault.process, RegisterWindow::in_process(), now);
    }
}

void VirtualDevices::power_up_again(std::size_t axis, RegisterWindow window, Tick now) {
    AxisDevice& it = devices_[axis].device;
    it.simulated = std::make_unique<SimulatedDevice>(window, it.simulated->plant(), tick_ns_, clocks_.device(axis, now),
                                                     static_cast<std::uint64_t>(now.value));
    it.window = std::move(window);
}

void VirtualDevices::overwrite(std::size_t axis, bool garbage, Tick now) {
    std::mt19937_64 random(seed_ ^ static_cast<std::uint64_t>(now.value));
    for (std::size_t word = 0; word < registers::kWindowBytes; word += sizeof(std::uint64_t)) {
        devices_[axis].device.window.store(word, garbage ? random() : 0);
    }
}

}  // namespace lockstep
