// The words of programs that switch an output of the machine.
#pragma once

#include <cstdint>
#include <span>

#include "core/outputs/output_config.hpp"

namespace lockstep {

struct AssignedWords {
    bool spindle = false;
    bool mist = false;
    bool flood = false;
    std::uint64_t digital = 0;  // bit n: M62 to M65 with P n
    std::uint32_t analog = 0;   // bit n: M67 and M68 with E n
    bool operator==(const AssignedWords&) const = default;

    bool has_digital(std::int32_t number) const { return number >= 0 && number < 64 && (digital >> number & 1) != 0; }
    bool has_analog(std::int32_t number) const { return number >= 0 && number < 32 && (analog >> number & 1) != 0; }
};

inline AssignedWords assigned_words(std::span<const OutputConfig> outputs) {
    AssignedWords words;
    for (const OutputConfig& output : outputs) {
        switch (output.use) {
            case OutputUse::Spindle:
            case OutputUse::SpindleReverse: words.spindle = true; break;
            case OutputUse::Mist: words.mist = true; break;
            case OutputUse::Flood: words.flood = true; break;
            case OutputUse::Number:
                if (output.is_analog()) {
                    words.analog |= std::uint32_t{1} << output.number;
                } else {
                    words.digital |= std::uint64_t{1} << output.number;
                }
                break;
            case OutputUse::Places: break;  // M69 asks for more: GcodePulses
        }
    }
    return words;
}

}  // namespace lockstep
