// Makes the two documents of DDS Security's access control, as XML to be signed (OMG DDS Security 1.1, 9.4.1).
#pragma once

#include <string>

#include "core/machine.hpp"
#include "services/security/rights.hpp"

namespace lockstep {

/// Returns the rules for all members in the machine's domain. They exclude unauthenticated peers and encrypt all
/// traffic. Each message carries a proof of its origin for each reader, so that a read-only member cannot publish in
/// another's name.
std::string governance_xml(const MachineConfig& machine);

struct Validity {
    std::string from;   // UTC, such as 2030-01-31T00:00:00
    std::string until;  // the same
};

/// Returns the core of the permissions: the topics that one member may write and read.
std::string allow_rule_xml(const MachineConfig& machine, const Member& member);

/// Returns a member's permissions, which deny everything else. `subject` is the certificate's subject in the format of
/// RFC 2253.
std::string permissions_xml(const MachineConfig& machine, const Member& member, const std::string& subject,
                            const Validity& validity);

}  // namespace lockstep
