// Makes the two documents of DDS Security's access control, as XML to be signed (OMG DDS Security 1.1, 9.4.1).
#pragma once

#include <optional>
#include <string>

#include "services/security/certificates.hpp"
#include "services/security/rights.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Returns the rules for all members in the machine's domain. They exclude unauthenticated peers and encrypt all
/// traffic. Each message carries a proof of its origin for each reader, so that a read-only member cannot publish in
/// another's name.
std::string governance_xml(const MachineSetup& machine);

/// Returns the core of the permissions: the topics that one member may write and read.
std::string allow_rule_xml(const MachineSetup& machine, const Member& member);

/// Returns a member's permissions, which deny everything else. `subject` is the certificate's subject in the format of
/// RFC 2253.
std::string permissions_xml(const MachineSetup& machine, const Member& member, const std::string& subject,
                            const Period& valid);

/// Returns the period for which permissions_xml() made the permissions; nullopt if it finds none.
std::optional<Period> period_in(const std::string& permissions_xml);

}  // namespace lockstep
