// A kept position <-> the text of its Protobuf message (idl/proto/position.proto).
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "core/axis/device/position_claim.hpp"

namespace lockstep {

std::string position_text(const KeptPosition& kept);

/// Error, for the log: why `text` is not the output of position_text.
std::expected<KeptPosition, std::string> position_from_text(std::string_view text);

}  // namespace lockstep
