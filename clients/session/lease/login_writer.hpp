// The writer of a person's commands: the login on this host.
#pragma once

#include <string>

#include "core/protocol/lease_holder.hpp"

namespace lockstep {

/// All commands of one login on one host belong to one writer, so a second terminal of the same person may give
/// commands, too. $LOCKSTEP_WRITER replaces the login's name: it makes people who share a login separate writers.
/// With NAME@HOST it replaces the host too: it makes one person's commands on several hosts one writer.
LeaseHolder login_writer();

/// The writer that a value of $LOCKSTEP_WRITER names, NAME or NAME@HOST, for a process on `host`. Pure.
LeaseHolder named_writer(const std::string& value, const std::string& host);

/// The same name and host always give the same id. Pure.
LeaseHolder writer_of(const std::string& name, const std::string& host);

}  // namespace lockstep
