// A kept position <-> the text of its Protobuf message (idl/proto/position.proto).
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "core/axis/device/position_claim.hpp"

namespace lockstep {

std::string position_text(const KeptPosition& kept);

/// Error: in words, why this is not what position_text has written.
std::expected<KeptPosition, std::string> position_from_text(std::string_view text);

}  // namespace lockstep
