// The protocol of a process. It is a part of the partitions' names, so that processes of different protocols do not
// receive each other. Each process also announces it in its participant's user data, so that the others can report the
// reason.
#pragma once

#include <dds/dds.h>

#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// Increases with every change that would make an older process misread a newer one (idl/README.md).
inline constexpr int kProtocol = 22;

/// Returns the user data of a participant, such as "lockstep 3 mill".
std::string calling_card(int protocol, const std::string& machine);

/// Returns the text to report about a process with this card; nullopt if it belongs to another machine or uses the same
/// protocol. Pure.
std::optional<std::string> other_version(std::string_view card, const std::string& machine);

void announce_version(dds_qos_t& participant, int protocol, const std::string& machine);

/// Reports processes of the machine that use another protocol through dds_log.hpp, while the participant exists.
void watch_versions(dds_entity_t participant, const std::string& machine);

}  // namespace lockstep
