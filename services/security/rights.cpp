#include "services/security/rights.hpp"

#include "core/enumeration.hpp"
#include "core/kinematics/motors.hpp"
#include "services/wire/dds/topics.hpp"

namespace lockstep {
namespace {

using enum Role;

template <typename T>
TopicRights of(std::vector<Role> writers, std::vector<Role> readers) {
    return {Topic<T>::kSpec.name, std::move(writers), std::move(readers)};
}

}  // namespace

std::string_view name_of(Role role) { return pick_name({"coordinator", "axis", "client", "viewer"}, role); }

Member axis_member(const MachineSetup& machine, MotorIndex motor) {
    return {"axis-" + motor_name(machine, motor), Axis, static_cast<std::uint32_t>(motor)};
}

std::vector<Member> members_of(const MachineSetup& machine) {
    std::vector<Member> members{coordinator_member(), standby_member()};
    for (const MotorIndex i : motor_indices(motor_count(machine))) { members.push_back(axis_member(machine, i)); }
    members.push_back(client_member());
    members.push_back(viewer_member());
    return members;
}

std::span<const TopicRights> rights() {
    static const std::vector<TopicRights> kRights{
        of<Frame>({Coordinator}, {Axis}),
        of<AxisCommand>({Coordinator}, {Axis}),
        of<MachineState>({Coordinator}, {Coordinator, Axis, Client, Viewer}),
        of<AxisState>({Axis}, {Coordinator, Axis, Client, Viewer}),
        of<AxisHealth>({Axis}, {Coordinator, Client, Viewer}),
        of<Command>({Client}, {Coordinator, Axis}),  // axes receive an emergency stop directly
        of<ProgramChunk>({Client}, {Coordinator}),
        of<Reply>({Coordinator}, {Client}),
        of<PublishedEvent>({Coordinator}, {Client, Viewer}),
        of<MachineValues>({Coordinator}, {Coordinator, Client, Viewer}),
        of<ClockRequest>({Axis}, {Coordinator}),
        of<ClockReply>({Coordinator}, {Axis}),
    };
    return kRights;
}

}  // namespace lockstep
