// Why a job pauses, and what the person at the machine has to do, or which input it waits for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// Hold: nothing of the program, but a hold that came to rest where a part of the program ends, or in a wait. Input:
/// the job goes on by itself. InputTimeout: a person lets it wait again.
enum class PauseReason : std::uint8_t {
    ProgramStop,
    OptionalStop,
    ToolChange,
    PalletChange,
    Hold,
    Input,
    InputTimeout
};

inline constexpr std::size_t kMaxPauseText = 127;  // bytes
inline constexpr std::int32_t kMaxTool = 1'000'000;

/// How an input ends a wait: L1 to L4 of M66.
enum class InputMode : std::uint8_t { Closes, Opens, IsClosed, IsOpen };

constexpr std::string_view name_of(InputMode mode) {
    switch (mode) {
        case InputMode::Closes: return "closes";
        case InputMode::Opens: return "opens";
        case InputMode::IsClosed: return "is closed";
        case InputMode::IsOpen: break;
    }
    return "is open";
}

/// Rest until an input is as wanted (M66).
struct InputWait {
    std::int32_t input = 0;  // its number in programs
    InputMode mode = InputMode::IsClosed;
    double seconds = 0;  // after which a person has to help
    bool operator==(const InputWait&) const = default;
};

/// Rest until a person resumes (M0, M1, M6, M60), or until an input is as wanted (M66).
struct Pause {
    PauseReason reason = PauseReason::ProgramStop;
    std::int32_t tool = 0;  // ToolChange: to be put in; 0: none
    std::string text;       // the program's message, UTF-8 without control characters, at most kMaxPauseText bytes
    std::optional<InputWait> wait;  // of M66
    bool operator==(const Pause&) const = default;
};

/// As reports and the API name them.
constexpr std::string_view name_of(PauseReason reason) {
    switch (reason) {
        case PauseReason::ProgramStop: return "program-stop";
        case PauseReason::OptionalStop: return "optional-stop";
        case PauseReason::ToolChange: return "tool-change";
        case PauseReason::PalletChange: return "pallet-change";
        case PauseReason::Input: return "input";
        case PauseReason::InputTimeout: return "input-timeout";
        case PauseReason::Hold: break;
    }
    return "hold";
}

/// The reason alone: "change to tool 2"
inline std::string what_of(const Pause& pause) {
    switch (pause.reason) {
        case PauseReason::ProgramStop: return "program stop";
        case PauseReason::OptionalStop: return "optional stop";
        case PauseReason::ToolChange:
            return pause.tool == 0 ? "take out the tool" : "change to tool " + std::to_string(pause.tool);
        case PauseReason::PalletChange: return "change the pallet";
        case PauseReason::Input: return "waits for an input";
        case PauseReason::InputTimeout: return "the wait for an input timed out, and resume waits again";
        case PauseReason::Hold: break;
    }
    return "held";
}

/// "change to tool 2: 6 mm end mill"
inline std::string text_of(const Pause& pause) {
    return what_of(pause) + (pause.text.empty() ? "" : ": " + pause.text);
}

/// Makes a text that a pause can carry: printable ASCII without blanks at its ends, and not too long.
inline std::string pause_text(std::string_view text) {
    std::string result;
    for (const char c : text) { result += c >= ' ' && c <= '~' ? c : ' '; }
    const std::size_t begin = std::min(result.find_first_not_of(' '), result.size());
    result = result.substr(begin, kMaxPauseText);
    result.erase(result.find_last_not_of(' ') + 1);
    return result;
}

}  // namespace lockstep
