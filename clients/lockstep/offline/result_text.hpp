// A result for a terminal, "exact: ..." or "not exact: ...", with its first words in colour if colours are enabled.
#pragma once

#include <string>

#include "clients/text/colour.hpp"

namespace lockstep {

/// `text` must begin with the result and a colon, and end with a newline. The newline is removed.
inline std::string result_text(std::string text, bool good) {
    text.pop_back();
    const std::size_t colon = text.find(':');
    if (!wants_colour()) { return text; }
    return painted(text.substr(0, colon), good ? kGood : kBad) + text.substr(colon);
}

}  // namespace lockstep
