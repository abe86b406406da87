// Texts about messages of the record that its processes could not write or send.
#pragma once

#include <cstdint>
#include <string>

#include "idl/proto/report.pb.h"

namespace lockstep {

/// The sum over all received processes, each since its start.
std::uint64_t lost_records(const proto::StatusReport& status);
/// Says which processes lost how many messages, with the remedy; empty if none did.
std::string record_loss_text(const proto::StatusReport& status);

}  // namespace lockstep
