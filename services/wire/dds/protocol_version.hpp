// Which protocol a process speaks: it is a part of the partitions, so that those of different ones do not hear each
// other; and each says in its participant's user data which, so that the others can say why.
#pragma once

#include <dds/dds.h>

#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// Goes up with every change by which an older process would misunderstand a newer one: see idl/README.md.
inline constexpr int kProtocol = 4;

/// "lockstep 3 mill".
std::string calling_card(int protocol, const std::string& machine);

/// What is to be said of a process with this card; nothing: it is of another machine, or speaks the same. Pure.
std::optional<std::string> other_version(std::string_view card, const std::string& machine);

void announce_version(dds_qos_t& participant, int protocol, const std::string& machine);

/// From now on, and as long as the participant lives, processes of the machine that speak another protocol are told of
/// by dds_log.hpp.
void watch_versions(dds_entity_t participant, const std::string& machine);

}  // namespace lockstep
