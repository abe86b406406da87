// A writer's name and host on the wire: texts of limited length that other people's terminals print.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "core/protocol/lease_holder.hpp"
#include "services/wire/dds/cut_text.hpp"
#include "services/wire/translate/checks.hpp"

namespace lockstep {

/// Cuts a text that is too long between two words or characters.
template <std::size_t N>
void write_text(std::string_view text, char (&wire)[N]) {
    static_assert(N == kMaxWriterBytes + 1);
    std::fill_n(wire, N, '\0');
    if (text.size() <= kMaxWriterBytes) {
        text.copy(wire, kMaxWriterBytes);
        return;
    }
    cut_text(text, kMaxWriterBytes).copy(wire, kMaxWriterBytes);
}

/// Returns a view of the text on the wire. Refuses a text without an end, and a text with control characters, which
/// could control a terminal.
template <std::size_t N>
std::string_view read_text(const char* field, const char (&wire)[N], Checks& check) {
    const std::string_view text(wire, strnlen(wire, N));
    check.within<std::size_t>(field, text.size(), 0, kMaxWriterBytes);
    check.printable(field, text);
    return text;
}

}  // namespace lockstep
