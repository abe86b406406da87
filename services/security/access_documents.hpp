// The two documents of DDS Security's access control, as XML to be signed (OMG DDS Security 1.1, 9.4.1).
#pragma once

#include <string>

#include "core/machine.hpp"
#include "services/security/rights.hpp"

namespace lockstep {

/// The rules for everybody in the machine's domain: unauthenticated peers are excluded; all traffic is encrypted; a
/// message to a reader is encrypted for that reader, so that a read-only member cannot publish in another's name.
std::string governance_xml(const MachineConfig& machine);

struct Validity {
    std::string from;   // UTC, as 2030-01-31T00:00:00
    std::string until;  // the same
};

/// The core of the permissions: what one member may write and read.
std::string allow_rule_xml(const MachineConfig& machine, const Member& member);

/// With its grant; everything else is denied. subject: its certificate's, as RFC 2253 writes it.
std::string permissions_xml(const MachineConfig& machine, const Member& member, const std::string& subject,
                            const Validity& validity);

}  // namespace lockstep
