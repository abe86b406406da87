// Texts of limited length that other people's terminals print: a writer's name and host, and why a job pauses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "services/wire/dds/cut_text.hpp"
#include "services/wire/translate/checks.hpp"

namespace lockstep {

/// Cuts a text that is too long between two words or characters.
template <std::size_t N>
void write_text(std::string_view text, char (&wire)[N]) {
    std::fill_n(wire, N, '\0');
    if (text.size() < N) {
        text.copy(wire, N - 1);
        return;
    }
    cut_text(text, N - 1).copy(wire, N - 1);
}

/// Returns a view of the text on the wire. Refuses a text without an end, and a text with control characters, which
/// could control a terminal.
template <std::size_t N>
std::string_view read_text(const char* field, const char (&wire)[N], Checks& check) {
    const std::string_view text(wire, strnlen(wire, N));
    check.within<std::size_t>(field, text.size(), 0, N - 1);
    check.printable(field, text);
    return text;
}

}  // namespace lockstep
