// The readers and writers of each topic. All permissions of members derive from this table.
//
// DDS Security grants by topic and partition, not by key. So each axis writes in its own partition, and readers accept
// a message about an axis only from that axis's partition (services/wire/bus/endpoints.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/setup/machine_setup.hpp"

namespace lockstep {

enum class Role : std::uint8_t { Coordinator, Axis, Client, Viewer };

std::string_view name_of(Role role);

/// A holder of a certificate: "coordinator", "standby", "axis-X", "client", "viewer".
struct Member {
    std::string name;
    Role role = Role::Viewer;
    std::optional<std::uint32_t> axis;  // the axis's number, if it is an axis
};

inline Member coordinator_member() { return {"coordinator", Role::Coordinator, {}}; }
inline Member standby_member() { return {"standby", Role::Coordinator, {}}; }
inline Member client_member() { return {"client", Role::Client, {}}; }
inline Member viewer_member() { return {"viewer", Role::Viewer, {}}; }
Member axis_member(const MachineSetup& machine, MotorIndex motor);

/// All possible members of a machine.
std::vector<Member> members_of(const MachineSetup& machine);

struct TopicRights {
    const char* topic;
    std::vector<Role> writers;
    std::vector<Role> readers;
};

/// All topics.
std::span<const TopicRights> rights();

}  // namespace lockstep
