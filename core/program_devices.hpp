// The state of spindle, coolant, tool and outputs, as set by the words of programs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

/// Pulses at places of the axis that has the output: M69.
struct PulseOrder {
    std::int32_t output = 0;
    double first_mm = 0;
    double spacing_mm = 0;    // signed
    std::uint32_t count = 0;  // 0: none
    std::uint32_t left = 0;   // of them, at the last rest
    bool operator==(const PulseOrder&) const = default;
};

enum class SpindleDirection : std::uint8_t { Stopped, Forward, Reverse };  // M5 M3 M4

struct ProgramDevices {
    SpindleDirection spindle = SpindleDirection::Stopped;
    double spindle_rpm = 0;  // commanded; meaningful while it turns
    bool mist = false;
    bool flood = false;
    std::optional<std::int32_t> tool;  // in the spindle; nullopt: none, or not known
    std::uint64_t outputs = 0;         // bit n: output n is on; outputs above 63 are not stored
    std::array<double, 16> analog{};   // of M67 and M68, by number; those above 15 are not stored
    PulseOrder pulses;
    bool operator==(const ProgramDevices&) const = default;

    void apply(const ProgramEvent& event);
    /// The words that stop the spindle and the coolant, if they are on.
    std::vector<ProgramEvent> words_off() const;
    /// The numbers of the outputs that are on, in ascending order.
    std::vector<std::uint32_t> outputs_on() const;
    /// Numbers that are not stored are off, and 0.
    bool output_is_on(std::int32_t number) const;
    double analog_output(std::int32_t number) const;
};

}  // namespace lockstep
