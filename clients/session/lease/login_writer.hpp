// The writer that a person's commands are: the login on this host.
#pragma once

#include <string>

#include "core/protocol/lease_holder.hpp"

namespace lockstep {

/// All commands of one login on one host are one writer: a second terminal of the same person may give commands, too.
/// $LOCKSTEP_WRITER is the name instead of the login's: people who share a login then are writers of their own.
LeaseHolder login_writer();

/// The same identity for the same name and host. Pure.
LeaseHolder writer_of(const std::string& name, const std::string& host);

}  // namespace lockstep
