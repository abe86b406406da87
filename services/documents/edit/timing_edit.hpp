// Writes a timing into the text of a machine's file, and leaves everything else in it as it is, comments too.
#pragma once

#include <expected>
#include <string>
#include <string_view>

#include "core/protocol/timing.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

/// The keys that set the slots: all of ProtocolTiming but where machine time comes from. As protobuf text, in one line.
std::string slots_text(const ProtocolTiming& timing);

/// The machine's text with these slots. Where machine time comes from stays; the limit of the clock error is lowered if
/// the new slot requires it. Error: what is wrong with the text, or with the machine that it would describe.
std::expected<std::string, Diagnostics> with_slots(std::string_view text, const ProtocolTiming& timing);

}  // namespace lockstep
