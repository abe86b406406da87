// How words for devices that the machine does not have are handled.
#pragma once

#include <cstdint>

namespace lockstep {

enum class WordRule : std::uint8_t {
    Refuse,
    Ignore,  // the word is published as an event on the path; nothing switches
};

enum class ToolChange : std::uint8_t {
    Pause,  // until a person resumes
    GoOn,   // published as an event on the path, for another program to act on
};

struct UnassignedWords {
    WordRule spindle = WordRule::Refuse;  // S M3 M4
    WordRule outputs = WordRule::Refuse;  // M62 to M65, M67 M68
    WordRule inputs = WordRule::Refuse;   // M66
    WordRule coolant = WordRule::Ignore;  // M7 M8
    ToolChange tool_change = ToolChange::Pause;
    bool operator==(const UnassignedWords&) const = default;
};

}  // namespace lockstep
