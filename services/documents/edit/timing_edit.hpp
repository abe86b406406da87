// Writes a timing into the text of a machine's file, and leaves everything else unchanged, including comments.
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "core/protocol/timing.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

/// Returns the keys that set the slots, as protobuf text in one line.
std::string slots_text(const ProtocolTiming& timing);

/// Returns the machine's text with these slots. It does not change the time source, and lowers the limit of the clock
/// error only if the new slot requires it. Error: what is wrong with the text, or with the machine that it would
/// describe.
std::expected<std::string, Diagnostics> with_slots(std::string_view text, const ProtocolTiming& timing);

}  // namespace lockstep
