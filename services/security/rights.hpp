// Who may write and who may read each topic: the one source of every member's permissions.
//
// DDS Security grants by topic and partition, not by key. So an axis writes in a partition of its own, and readers
// believe what is said of an axis only if it comes from there (services/wire/bus/endpoints.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

enum class Role : std::uint8_t { Coordinator, Axis, Client, Viewer };

std::string_view name_of(Role role);

/// One that has a certificate of its own: "coordinator", "standby", "axis-X", "client", "viewer".
struct Member {
    std::string name;
    Role role = Role::Viewer;
    std::optional<std::uint32_t> axis;  // of an axis: which
};

inline Member coordinator_member() { return {"coordinator", Role::Coordinator, {}}; }
inline Member standby_member() { return {"standby", Role::Coordinator, {}}; }
inline Member client_member() { return {"client", Role::Client, {}}; }
inline Member viewer_member() { return {"viewer", Role::Viewer, {}}; }
Member axis_member(const MachineConfig& machine, std::size_t axis);

/// All that a machine can have.
std::vector<Member> members_of(const MachineConfig& machine);

struct TopicRights {
    const char* topic;
    std::vector<Role> writers;
    std::vector<Role> readers;
};

/// Every topic there is.
std::span<const TopicRights> rights();

}  // namespace lockstep
