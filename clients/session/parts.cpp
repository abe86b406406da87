#include "clients/session/parts.hpp"

#include <algorithm>

#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

constexpr const char* kAbsent = "absent";

bool is_present(const std::vector<PresentProcess>& present, std::optional<MotorIndex> motor) {
    return std::ranges::find(present, motor, &PresentProcess::motor) != present.end();
}

proto::AwaitedPart awaited(const std::string& name, const std::string& host, const std::string& state) {
    proto::AwaitedPart part;
    part.set_name(name);
    if (!host.empty()) { part.set_host(host); }
    part.set_state(state);
    return part;
}

/// The state of an axis that is not received by this client or not by the coordinator.
std::string axis_state(const MachineSetup& machine, const KnownParts& known, MotorIndex motor) {
    if (known.motors_present.contains(motor)) { return "started, but its messages do not reach the coordinator"; }
    if (!is_present(known.present, motor)) { return kAbsent; }
    const bool lacks_time = machine.timing.time_source == TimeSource::Network;
    return lacks_time ? "started, waits for the coordinator's clock" : "started, but its messages are not received";
}

}  // namespace

KnownParts known_parts(const Session& session) {
    KnownParts known{.coordinator_present = session.state() && !session.is_silent(), .present = session.present()};
    for (const MotorIndex i : motor_indices(session.received().kinematics().motors().size())) {
        if (session.received().motor_present(i)) { known.motors_present.insert(i); }
    }
    if (known.coordinator_present) { known.motors_present_at_coordinator = session.state()->state.motors_present; }
    return known;
}

std::string part_name(const MachineSetup& machine, std::optional<MotorIndex> motor) {
    return motor ? Kinematics(machine).label(*motor) : "coordinator";
}

std::vector<proto::AwaitedPart> awaited_parts(const MachineSetup& machine, const KnownParts& known) {
    std::vector<proto::AwaitedPart> parts;
    if (!known.coordinator_present) {
        const bool is_there = is_present(known.present, std::nullopt);
        parts.push_back(awaited(part_name(machine, {}), machine.coordinator_host,
                                is_there ? "started, but its messages are not received" : kAbsent));
    }
    const std::vector<MotorConfig> motors = motors_of(machine);
    for (const MotorIndex i : motor_indices(motors.size())) {
        const bool is_known = !known.coordinator_present || known.motors_present_at_coordinator.contains(i);
        if (known.motors_present.contains(i) && is_known) { continue; }
        parts.push_back(awaited(part_name(machine, i), motors[i].host, axis_state(machine, known, i)));
    }
    return parts;
}

void add_awaited(const Session& session, proto::StatusReport& report) {
    for (proto::AwaitedPart& part : awaited_parts(session.config(), known_parts(session))) {
        *report.add_waits_for() = std::move(part);
    }
}

std::string awaited_text(const proto::StatusReport& report) {
    std::string text;
    for (const proto::AwaitedPart& part : report.waits_for()) {
        const std::string where = part.has_host() ? " on " + part.host() : "";
        const bool is_absent = part.state() == kAbsent;
        text += "waits for " + part.name() + where + ": " + part.state() +
                (is_absent && part.has_host() ? "; on " + part.host() + ": lockstep up" : "") + "\n";
    }
    return text;
}

}  // namespace lockstep
