// The directory of a machine's keys: what is in it, and how it is made.
//
//   identity-ca.pem permissions-ca.pem governance.p7s   for all
//   NAME.pem NAME.key NAME.p7s                          for one member: certificate, private key, permissions
//   ca/identity-ca.key ca/permissions-ca.key            with these members are made: no process needs them
#pragma once

#include <chrono>
#include <expected>
#include <filesystem>
#include <string>

#include "core/machine.hpp"
#include "services/security/rights.hpp"
#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// The files that one member needs.
Credentials credentials_in(const std::filesystem::path& directory, const Member& member);

/// UTC, as 2030-01-31T00:00:00Z.
std::string time_text(std::chrono::sys_seconds time);

struct MadeKeys {
    std::string replaced;  // where what stood there before is now; empty: nothing stood there
};

/// Makes all that members_of(machine) need: whole, or not at all. Error: the directory is there and not empty, and
/// `replace` was not said; or the file and the reason.
std::expected<MadeKeys, std::string> make_keys(const MachineConfig& machine, const std::filesystem::path& directory,
                                               std::chrono::days valid, bool replace);

}  // namespace lockstep
