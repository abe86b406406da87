// Colours on a terminal, if enabled.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>

namespace lockstep {

inline constexpr std::string_view kGood = "\x1b[32m";
inline constexpr std::string_view kBad = "\x1b[31m";
inline constexpr std::string_view kWarning = "\x1b[33m";
inline constexpr std::string_view kBold = "\x1b[1m";
inline constexpr std::string_view kFaint = "\x1b[2m";

/// True if standard output is a terminal and NO_COLOR (no-color.org) is not set.
inline bool wants_colour() {
    const char* refused = std::getenv("NO_COLOR");
    return isatty(STDOUT_FILENO) == 1 && (refused == nullptr || *refused == '\0');
}

inline std::string painted(std::string_view text, std::string_view colour) {
    return std::string(colour) + std::string(text) + "\x1b[0m";
}

}  // namespace lockstep
