// Which protocol a process uses: it is a part of the partitions, so that processes of different protocols do not
// receive each other; and each process announces it in its participant's user data, so that the others can report why.
#pragma once

#include <dds/dds.h>

#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// Increases with every change by which an older process would misread a newer one: see idl/README.md.
inline constexpr int kProtocol = 9;

/// "lockstep 3 mill".
std::string calling_card(int protocol, const std::string& machine);

/// The text to report of a process with this card; nothing: it is of another machine, or uses the same protocol. Pure.
std::optional<std::string> other_version(std::string_view card, const std::string& machine);

void announce_version(dds_qos_t& participant, int protocol, const std::string& machine);

/// From now on, while the participant exists, processes of the machine that use another protocol are reported through
/// dds_log.hpp.
void watch_versions(dds_entity_t participant, const std::string& machine);

}  // namespace lockstep
