// The directory of a machine's keys. Its content:
//
//   identity-ca.pem permissions-ca.pem governance.p7s   for all
//   NAME.pem NAME.key NAME.p7s                          for one member: certificate, private key, permissions
//   ca/identity-ca.key ca/permissions-ca.key            used to make members: no process needs them
#pragma once

#include <chrono>
#include <expected>
#include <filesystem>
#include <string>

#include "services/security/certificates.hpp"
#include "services/security/rights.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/participant.hpp"

namespace lockstep {

/// The files that one member needs.
Credentials credentials_in(const std::filesystem::path& directory, const Member& member);

/// Returns the time in UTC, such as 2030-01-31T00:00:00Z.
std::string time_text(std::chrono::sys_seconds time);

struct MadeKeys {
    std::string replaced;  // where the previous content is now; empty if there was none
};

/// Makes the keys of all members_of(machine), either completely or not at all. Error: the directory is not empty and
/// `replace` is not set; or the file and the reason.
std::expected<MadeKeys, std::string> make_keys(const MachineSetup& machine, const std::filesystem::path& directory,
                                               const Period& valid, bool replace);

}  // namespace lockstep
