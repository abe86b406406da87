// Checks whether a process may join a machine: its files must exist, be private, be valid, and be made for this
// machine.
#pragma once

#include <chrono>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/security/certificates.hpp"
#include "services/security/rights.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/participant.hpp"

namespace lockstep {

inline constexpr std::chrono::days kNearEnd{30};

struct MemberCheck {
    std::vector<std::string> errors;    // each names the file and the remedy
    std::vector<std::string> warnings;  // one of the files expires within kNearEnd
    std::optional<CertificateFacts> certificate;
    std::optional<std::chrono::sys_seconds> until;  // when the first of the member's files expires
};

MemberCheck check_member(const MachineSetup& machine, const std::filesystem::path& directory, const Member& member,
                         std::chrono::sys_seconds now);

struct Admission {
    Membership membership;
    std::optional<std::chrono::sys_seconds> until;  // when the first of its files expires; nullopt without security
};

/// Admits a member with the files that the machine's configuration names. Without security no files are needed. Error:
/// the first problem.
std::expected<Admission, std::string> admit(const MachineSetup& machine, const Member& member);

}  // namespace lockstep
