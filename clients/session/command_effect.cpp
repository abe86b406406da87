#include "clients/session/command_effect.hpp"

#include <fmt/format.h>

#include "clients/session/reports.hpp"
#include "clients/text/format.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/names.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::seconds kPatience{10};

bool shows_effect(CommandKind command, MachinePhase phase) {
    const bool moves = phase == MachinePhase::Homing || phase == MachinePhase::Jogging ||
                       phase == MachinePhase::Running || phase == MachinePhase::Stopping;
    switch (command) {
        case CommandKind::Hold:
        case CommandKind::Stop:
        case CommandKind::EmergencyStop: return !moves;
        case CommandKind::Reset: return phase == MachinePhase::Idle || phase == MachinePhase::Fault;
        default: return true;
    }
}

std::string missing_axes(const Session& session) {
    std::string names;
    for (const MotorIndex i : motor_indices(session.received().kinematics().motors().size())) {
        if (session.state()->state.motors_present.contains(i)) { continue; }
        names += (names.empty() ? "" : ", ") + motor_name(session.config(), i);
    }
    return names;
}

std::string late_text(const Session& session, CommandKind command) {
    if (!session.state()) { return "the machine has not published its state yet; see: lockstep status"; }
    const std::string still =
        fmt::format("the machine is still {} after {} s", name_of(session.state()->state.phase), kPatience.count());
    const std::string missing = missing_axes(session);
    if (!missing.empty()) {
        return fmt::format("{}; no messages are received from {}; start the process, or see its log", still, missing);
    }
    return still +
           (command == CommandKind::Reset ? "; see: lockstep status" : "; to stop all pulses at once: lockstep estop");
}

}  // namespace

std::expected<MachinePhase, std::string> await_effect(Session& session, CommandKind command) {
    const auto replied = monotonic_now();
    const auto slot = std::chrono::microseconds{session.config().timing.slot_us};
    const auto is_shown = [&] {
        const auto& received = session.state();
        return received && received->time > replied + slot && shows_effect(command, received->state.phase);
    };
    if (!session.receive_until(kPatience, is_shown)) { return std::unexpected(late_text(session, command)); }
    const MachineState& state = session.state()->state;
    if (command != CommandKind::Reset || state.phase != MachinePhase::Fault) { return state.phase; }
    const auto fault = fault_of(state, session.config());
    return std::unexpected("the machine is in Fault again" + (fault ? "\n" + fault_text(*fault) : std::string()));
}

}  // namespace lockstep
