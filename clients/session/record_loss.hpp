// Texts about messages of the record that its processes could not write or send.
#pragma once

#include <cstdint>
#include <string>

#include "idl/proto/report.pb.h"

namespace lockstep {

/// Of all processes that are received, since the start of each.
std::uint64_t lost_records(const proto::StatusReport& status);
/// Which processes lost how many, and the remedy; empty: none did.
std::string record_loss_text(const proto::StatusReport& status);

}  // namespace lockstep
