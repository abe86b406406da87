// A verdict for a terminal: "exact: ..." or "not exact: ...", its first words in colour where colours are wanted.
#pragma once

#include <string>

#include "clients/text/colour.hpp"

namespace lockstep {

/// `text` begins with the verdict, a colon behind it, and ends with a newline, which is taken off.
inline std::string verdict_text(std::string text, bool good) {
    text.pop_back();
    const std::size_t verdict = text.find(':');
    if (!wants_colour()) { return text; }
    return painted(text.substr(0, verdict), good ? kGood : kBad) + text.substr(verdict);
}

}  // namespace lockstep
