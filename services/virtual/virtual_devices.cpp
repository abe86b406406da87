#include "services/virtual/virtual_devices.hpp"

#include <random>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

RegisterRing segment_ring(const RegisterWindow& window) {
    return {registers::kSegmentRing, window.load(registers::kSegmentEntries), registers::kSegmentRingEntryBytes};
}

/// Starts the frame a quarter of a step further, so it does not join what is before it.
void damage_newest_frame(RegisterWindow& window) {
    using namespace registers;
    const RegisterRing ring = segment_ring(window);
    for (std::uint64_t n = window.load(kSegmentHead); n != window.load(kSegmentTail); --n) {
        const std::size_t entry = ring.entry(n - 1);
        if ((window.load(entry + kSegmentRingHeaderTag) & kSegmentRingHeaderTagIsHeader) == 0) { continue; }
        const std::size_t phase = entry + kSegmentRingHeaderPhase;
        return window.store(phase, window.load(phase) + (std::uint64_t{1} << 62));
    }
}

/// Makes the frame's last piece two steps longer, so the frame joins the one before but ends elsewhere.
void mislead_newest_frame(RegisterWindow& window) {
    using namespace registers;
    const std::size_t entry = segment_ring(window).entry(window.load(kSegmentHead) - 1);
    const auto ticks = static_cast<double>(kSegmentRingPieceTagTicks.of(window.load(entry + kSegmentRingPieceTag)));
    const auto more = static_cast<std::uint64_t>(2 / ticks * 0x1p64);
    window.store(entry + kSegmentRingPieceVelocity, window.load(entry + kSegmentRingPieceVelocity) + more);
}

}  // namespace

VirtualDevices::VirtualDevices(const VirtualOptions& options, const MachineClocks& clocks, Tick now)
    : clocks_(clocks),
      machine_(options.machine),
      motors_(motors_of(machine_)),
      seed_(options.seed),
      contacts_(machine_) {
    for (std::size_t i = 0; i < motors_.size(); ++i) {
        devices_.push_back({.abilities = i < options.devices.size() ? options.devices[i] : DeviceAbilities{},
                            .window = RegisterWindow::in_process(),
                            .simulated = nullptr,
                            .link = {}});
        const bool has_link = i < options.links.size() && options.links[i].most > Ticks{};
        if (has_link) { devices_[i].link.emplace(options.links[i], seed_ + i); }
        power_up(MotorIndex{i}, devices_[i].window, plant_of(machine_, motors_[i]), now);
    }
}

std::expected<std::unique_ptr<DevicePort>, std::string> VirtualDevices::open(MotorIndex motor) {
    if (devices_[motor].is_gone) { return std::unexpected("no process holds its registers"); }
    auto driver = attach_driver(devices_[motor].window, machine_, motors_[motor]);
    if (!driver) { return std::unexpected(driver.error()); }
    if (!estimates_clock(machine_, motor)) { return std::make_unique<WindowPort>(std::move(*driver)); }
    const auto now = [this, motor] { return devices_[motor].now; };
    const auto process_clock = [this, motor](Tick at) { return clocks_.process(motor, at); };
    if (!devices_[motor].link) {
        return std::make_unique<WindowPort>(std::move(*driver), [=] { return process_clock(now()); });
    }
    devices_[motor].link->attach(std::move(*driver));
    return std::make_unique<LatePort>(*devices_[motor].link, now, process_clock);
}

void VirtualDevices::advance(MotorIndex motor, Tick now) {
    Device& device = devices_[motor];
    device.now = now;
    if (device.is_stopped) { return; }
    if (device.link) { deliver(motor, now); }
    device.simulated->advance(clocks_.device(motor, now));
}

void VirtualDevices::deliver(MotorIndex motor, Tick now) {
    Device& device = devices_[motor];
    for (auto at = device.link->next(); at && *at <= now; at = device.link->next()) {
        device.simulated->advance(clocks_.device(motor, *at));
        device.link->arrive();
    }
}

void VirtualDevices::set_input(std::size_t input, bool closed, Tick now) {
    const InputConfig& config = machine_.inputs[input];
    const MotorIndex motor = motor_named(machine_, config.motor).value();
    advance(motor, now);
    lockstep::set_input((*this)[motor].plant(), config, closed);
}

/// An axis that searches its switch, or a probe that approaches the workpiece, goes a small part of a step in kLook.
/// Only where a switch may change, so many times are looked at.
void VirtualDevices::follow_switches(Tick now) {
    if (contacts_.none()) { return; }
    constexpr Ticks kLook{16};
    for (Device& device : devices_) { device.next_step.reset(); }
    const Ticks ticks = now - followed_;
    const bool may_change = contacts_.may_change_within(ticks);
    for (Tick at = followed_ + kLook; may_change && at < now; at += kLook) {
        if (!may_have_stepped(at)) { continue; }
        follow_switches_at(at);
        note_next_steps(now);
    }
    follow_switches_at(now);
    followed_ = now;
}

/// Nothing changes between steps, unless a message arrives at a device on its link.
bool VirtualDevices::may_have_stepped(Tick now) const {
    for (const MotorIndex i : motor_indices(devices_.size())) {
        const auto& next = devices_[i].next_step;
        if (devices_[i].link || !next || clocks_.device(i, now) >= *next) { return true; }
    }
    return false;
}

void VirtualDevices::note_next_steps(Tick until) {
    for (const MotorIndex i : motor_indices(devices_.size())) {
        devices_[i].next_step = devices_[i].simulated->next_step(clocks_.device(i, until));
    }
}

void VirtualDevices::follow_switches_at(Tick now) {
    std::vector<Position> slides;
    for (const MotorIndex i : motor_indices(devices_.size())) {
        advance(i, now);
        slides.push_back(Position::steps(to_steps(motors_[i], (*this)[i].plant().position_mm())));
    }
    contacts_.follow(slides, [&](std::size_t input, bool closed) {
        const InputConfig& config = machine_.inputs[input];
        set_contact((*this)[motor_named(machine_, config.motor).value()].plant(), config, closed);
    });
}

void VirtualDevices::apply(const VirtualFault& fault, bool begins, Tick now) {
    advance(fault.motor(), now);
    fault.is_of_device() ? strike(fault, begins, now) : disturb(fault, begins);
    advance(fault.motor(), now);
}

void VirtualDevices::disturb(const VirtualFault& fault, bool begins) {
    const MotorIndex i = fault.motor();
    if (fault.kind == VirtualFault::Kind::Stick) {
        (*this)[i].plant().stick(fault.contact, begins ? std::optional(fault.closed) : std::nullopt);
    } else if (fault.kind == VirtualFault::Kind::Push && begins) {
        (*this)[i].plant().push(fault.push_steps);
    } else if (begins) {
        RegisterWindow& window = devices_[i].window;
        fault.ends_elsewhere ? mislead_newest_frame(window) : damage_newest_frame(window);
    }
}

void VirtualDevices::strike(const VirtualFault& fault, bool begins, Tick now) {
    using Kind = VirtualFault::Kind;
    Device& device = devices_[fault.process];
    if (device.link && device.is_stopped) { device.link->hold_until(now); }
    device.is_stopped = begins && fault.kind != Kind::Overwrite;
    device.is_gone = begins && fault.kind == Kind::KillDevice;
    if (fault.kind == Kind::Overwrite) {
        begins ? overwrite(fault.motor(), fault.garbage, now)
               : power_up(fault.motor(), device.window, (*this)[fault.motor()].plant(), now);
    } else if (fault.kind == Kind::KillDevice && !begins) {
        power_up(fault.motor(), RegisterWindow::in_process(), (*this)[fault.motor()].plant(), now);
    }
}

void VirtualDevices::power_up(MotorIndex motor, const RegisterWindow& window, Plant plant, Tick now) {
    const Tick shown = clocks_.device(motor, now);
    if (devices_[motor].link) { devices_[motor].link->power_up(); }
    devices_[motor].window = window;
    devices_[motor].simulated =
        std::make_unique<SimulatedDevice>(window, std::move(plant), machine_.tick_ns, shown,
                                          static_cast<std::uint64_t>(now.value), devices_[motor].abilities);
}

void VirtualDevices::overwrite(MotorIndex motor, bool garbage, Tick now) {
    std::mt19937_64 random(seed_ ^ static_cast<std::uint64_t>(now.value));
    for (std::size_t word = 0; word < registers::kWindowBytes; word += sizeof(std::uint64_t)) {
        devices_[motor].window.store(word, garbage ? random() : 0);
    }
}

}  // namespace lockstep
