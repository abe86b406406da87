// Cuts texts that are too long for a message or a log line.
#pragma once

#include <string>
#include <string_view>

namespace lockstep {

/// Returns at most `most` bytes. It cuts between two words if it can, never within a UTF-8 character, and appends an
/// ellipsis.
inline std::string cut_text(std::string_view text, std::size_t most) {
    constexpr std::string_view kEllipsis = " ...";
    if (text.size() <= most) { return std::string(text); }
    std::size_t end = most - kEllipsis.size();
    const std::size_t space = text.rfind(' ', end);
    if (space != text.npos && space > 0) { return std::string(text.substr(0, space)).append(kEllipsis); }
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) { --end; }
    return std::string(text.substr(0, end)).append(kEllipsis);
}

}  // namespace lockstep
