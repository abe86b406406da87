#include "tests/simulation/simtest/record/explain.hpp"

#include <algorithm>
#include <array>

namespace lockstep::simtest {
namespace {

enum class Cause : std::uint8_t {
    EmergencyStop,
    StopInput,
    Loss,
    Corruption,
    Freeze,
    Stall,
    CrashOfAxis,
    CrashOfCoordinator,
    Cut,
    SetClock,
    Switch,
    Push,
    Hand,
    DamagedFrame,
    Device,
    SilentDevice,
    SilentLink,
    OwnClocks,
    StoppedHoming
};

struct Explanation {
    Cause cause;
    FaultCode fault;
};

constexpr std::array kExplanations{
    Explanation{Cause::EmergencyStop, FaultCode::EmergencyStopped},
    Explanation{Cause::EmergencyStop, FaultCode::EmergencyStopInput},
    // It stops the motor of its device first, and the other motors of the axis later.
    Explanation{Cause::StopInput, FaultCode::MotorsSkewed},
    // In three epochs in a row no frame ran, or one axis received other messages than the others.
    Explanation{Cause::Loss, FaultCode::FrameLate},
    Explanation{Cause::Loss, FaultCode::FramesDiffer},
    Explanation{Cause::Corruption, FaultCode::FrameLate},
    Explanation{Cause::Corruption, FaultCode::FramesDiffer},
    // A state of an unknown process, or under another name, looks like an axis that has restarted.
    Explanation{Cause::Corruption, FaultCode::AxisLost},
    // A state with another position looks like an axis that is elsewhere.
    Explanation{Cause::Corruption, FaultCode::PositionMismatch},
    Explanation{Cause::Corruption, FaultCode::TouchMissed},
    Explanation{Cause::Freeze, FaultCode::FramesDiffer},
    Explanation{Cause::Freeze, FaultCode::AxisLost},
    // Axes that move on their own halt without their coordinator.
    Explanation{Cause::Freeze, FaultCode::CoordinatorSilent},
    Explanation{Cause::CrashOfCoordinator, FaultCode::CoordinatorSilent},
    Explanation{Cause::Cut, FaultCode::CoordinatorSilent},
    // The first frame of a run was armed after its start: the device refuses it.
    Explanation{Cause::Stall, FaultCode::DeviceFault},
    Explanation{Cause::CrashOfAxis, FaultCode::AxisLost},
    Explanation{Cause::Cut, FaultCode::FrameLate},
    Explanation{Cause::Cut, FaultCode::FramesDiffer},
    Explanation{Cause::Cut, FaultCode::AxisLost},
    // An axis with a clock that is seconds off sends and receives nothing in time.
    Explanation{Cause::SetClock, FaultCode::FrameLate},
    Explanation{Cause::SetClock, FaultCode::FramesDiffer},
    Explanation{Cause::SetClock, FaultCode::AxisLost},
    // Its pulses ceased at a touch, but by its new clock at another time than those of the others.
    Explanation{Cause::SetClock, FaultCode::NotAtRest},
    Explanation{Cause::Switch, FaultCode::LimitHit},
    Explanation{Cause::Switch, FaultCode::HomeSwitchStuck},
    Explanation{Cause::Switch, FaultCode::HomeSwitchNotFound},
    Explanation{Cause::Switch, FaultCode::HomeSwitchUnsteady},
    // The slide was pushed onto a limit in a search, or back behind the switch.
    Explanation{Cause::Push, FaultCode::HomeSwitchNotFound},
    Explanation{Cause::Push, FaultCode::HomeSwitchStuck},
    Explanation{Cause::Push, FaultCode::HomeSwitchUnsteady},
    Explanation{Cause::Push, FaultCode::FollowingError},
    // The simulated motor keeps the speed at which its pulses ended, and slips when it moves again too soon.
    Explanation{Cause::EmergencyStop, FaultCode::FollowingError},
    // It was pushed back twice as far as the motor had gone.
    Explanation{Cause::Push, FaultCode::EncoderReversed},
    Explanation{Cause::Push, FaultCode::LimitHit},
    Explanation{Cause::DamagedFrame, FaultCode::DeviceFault},
    Explanation{Cause::DamagedFrame, FaultCode::FramesDiffer},
    Explanation{Cause::Device, FaultCode::DeviceLost},
    // An operator moved it before a homing in place, and it was still homed.
    Explanation{Cause::Hand, FaultCode::FollowingError},
    // While motors of one axis search their switches, one stands and the other goes on.
    Explanation{Cause::Freeze, FaultCode::MotorsSkewed},
    Explanation{Cause::CrashOfAxis, FaultCode::MotorsSkewed},
    Explanation{Cause::Cut, FaultCode::MotorsSkewed},
    Explanation{Cause::SetClock, FaultCode::MotorsSkewed},
    Explanation{Cause::Switch, FaultCode::MotorsSkewed},
    Explanation{Cause::Push, FaultCode::MotorsSkewed},
    Explanation{Cause::Device, FaultCode::MotorsSkewed},
    // Its device stopped one motor of an axis on the path, before the others.
    Explanation{Cause::DamagedFrame, FaultCode::MotorsSkewed},
    // A simulated device that stood still catches up with its inputs as they are now. So it sees a touch too early.
    Explanation{Cause::SilentDevice, FaultCode::TouchMissed},
    // One motor of an axis was stopped before its first frame, and another one braked in it. So they are farther apart.
    Explanation{Cause::StoppedHoming, FaultCode::MotorsSkewed},
    // A device that takes no segments can run out of room for frames before it counts as lost.
    Explanation{Cause::SilentDevice, FaultCode::DeviceFault},
    // Orders that wait for a link reach the device after the start of their frame. It runs the tail then.
    Explanation{Cause::SilentLink, FaultCode::FramesDiffer},
    // A process that does not receive the coordinator's clock for long is no longer certain of the time. Delays that
    // change move its estimate, from three quarters of the limit on.
    Explanation{Cause::OwnClocks, FaultCode::ClockUncertain},
};

bool is_coordinator(const VirtualFault& fault, const MachineConfig& machine) {
    return fault.process >= motor_count(machine);
}

Cause cause_of(const VirtualFault& fault, const MachineConfig& machine) {
    switch (fault.kind) {
        case VirtualFault::Kind::Freeze: return Cause::Freeze;
        case VirtualFault::Kind::Crash:
            return is_coordinator(fault, machine) ? Cause::CrashOfCoordinator : Cause::CrashOfAxis;
        case VirtualFault::Kind::SetClock: return Cause::SetClock;
        case VirtualFault::Kind::Stick: return Cause::Switch;
        case VirtualFault::Kind::Push: return Cause::Push;
        case VirtualFault::Kind::DamageFrame: return Cause::DamagedFrame;
        case VirtualFault::Kind::StopDevice:
        case VirtualFault::Kind::KillDevice:
        case VirtualFault::Kind::Overwrite: return Cause::Device;
        case VirtualFault::Kind::Cut: break;
    }
    return Cause::Cut;
}

std::vector<Cause> causes_in(const Recording& recording) {
    std::vector<Cause> causes;
    if (!recording.emergencies.empty()) { causes.push_back(Cause::EmergencyStop); }
    if (recording.was_stop_pressed()) { causes.push_back(Cause::StopInput); }
    if (recording.was_moved_by_hand) { causes.push_back(Cause::Hand); }
    const auto is_stopped_homing = [](const JobRecord& job) {
        return job.homing && job.outcome == JobOutcome::Stopped;
    };
    if (std::ranges::any_of(recording.jobs, is_stopped_homing)) { causes.push_back(Cause::StoppedHoming); }
    if (recording.network.lost > 0) { causes.push_back(Cause::Loss); }
    if (recording.network.corrupted > 0) { causes.push_back(Cause::Corruption); }
    for (const VirtualFault& fault : recording.faults) {
        causes.push_back(cause_of(fault, recording.machine));
        const bool is_silent =
            fault.kind == VirtualFault::Kind::StopDevice || fault.kind == VirtualFault::Kind::KillDevice;
        if (is_silent) { causes.push_back(Cause::SilentDevice); }
        const bool has_link = is_silent && recording.motors[fault.process].lateness > Ticks{};
        if (has_link) { causes.push_back(Cause::SilentLink); }
        if (fault.in_loop) { causes.push_back(Cause::Stall); }
    }
    const bool disturbed = recording.lossy() || !recording.faults.empty();
    const NetworkBehaviour& network = recording.network;
    const bool is_uneven = network.delay_min < network.delay_max || network.reply_longer > Ticks{};
    if ((disturbed || is_uneven) && recording.machine.estimates_clocks()) { causes.push_back(Cause::OwnClocks); }
    return causes;
}

}  // namespace

bool explains(const Recording& recording, FaultCode fault) {
    const std::vector<Cause> causes = causes_in(recording);
    return std::ranges::any_of(kExplanations, [&](const Explanation& e) {
        return e.fault == fault && std::ranges::find(causes, e.cause) != causes.end();
    });
}

bool is_tolerable(const VirtualFault& fault, const MachineConfig& machine) {
    if (fault.kind == VirtualFault::Kind::Stick && fault.contact == &PlantInputs::home) { return true; }
    if (fault.kind != VirtualFault::Kind::Freeze) { return false; }
    const ProtocolTiming& t = machine.timing;
    // A coordinator must not only be back in time, but also make and send the next frame in time.
    const int sends = t.send_ahead_slots - t.send_deadline_slots();
    const int slots = is_coordinator(fault, machine) ? std::min(t.stall_slots, sends) : t.stall_slots;
    return fault.lasts <= machine.slot_ticks() * slots;
}

std::optional<std::size_t> may_be_apart(const VirtualFault& fault, const MachineConfig& machine) {
    if (is_coordinator(fault, machine) || is_tolerable(fault, machine)) { return std::nullopt; }
    const bool cut_off = !fault.peer && fault.outgoing && fault.incoming;
    if (fault.kind == VirtualFault::Kind::Cut && !cut_off) { return std::nullopt; }
    return fault.process;
}

Tick unread_from(const VirtualFault& fault, const Recording& recording) {
    if (!fault.is_of_device()) { return fault.at; }
    const Ticks slot = recording.machine.slot_ticks();
    const Ticks starting = slot * 10;
    Tick from = fault.at;
    for (const VirtualFault& away : recording.faults) {
        using Kind = VirtualFault::Kind;
        const bool mine = away.process == fault.process && (away.kind == Kind::Crash || away.kind == Kind::Freeze);
        if (mine && away.at <= fault.at && away.end() + starting >= fault.at) { from = std::min(from, away.at); }
    }
    return from - slot - recording.motors[fault.process].lateness;
}

bool may_be_stopped(const Recording& recording, std::size_t axis, Tick from, Tick until) {
    return std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
        if (!fault.is_of_plant() || unread_from(fault, recording) > until) { return false; }
        const bool is_over = fault.kind == VirtualFault::Kind::Stick && fault.end() < from;
        if (fault.process == axis) { return !is_over; }
        return recording.motors[axis].mates.contains(
            MotorIndex{fault.process});  // where the fault has left the other is not over
    });
}

}  // namespace lockstep::simtest
