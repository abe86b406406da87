// The two documents of DDS Security's access control, as XML to be signed (OMG DDS Security 1.1, 9.4.1).
#pragma once

#include <string>

#include "core/machine.hpp"
#include "services/security/rights.hpp"

namespace lockstep {

/// What holds for everybody in the machine's domain: who is not proved is out; all is encrypted; what a reader is sent
/// is sealed for that reader, so that one that may only listen cannot speak in another's name.
std::string governance_xml(const MachineConfig& machine);

struct Validity {
    std::string from;   // UTC, as 2030-01-31T00:00:00
    std::string until;  // the same
};

/// The heart of the permissions: what one member may write and read.
std::string allow_rule_xml(const MachineConfig& machine, const Member& member);

/// With its grant; all else is denied. subject: its certificate's, as RFC 2253 writes it.
std::string permissions_xml(const MachineConfig& machine, const Member& member, const std::string& subject,
                            const Validity& validity);

}  // namespace lockstep
