// The outputs of a machine: which channel of a device each of them is, and which words of programs switch it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumeration.hpp"

namespace lockstep {

/// The words that switch an output. One row for each use: its name in the machine's file, whether words name the output
/// by its number, and whether it may be analog. The order is that of idl/proto/machine.proto.
// clang-format off
#define LOCKSTEP_OUTPUT_USES(X) \
    /* M62 to M65 if it is digital, M67 and M68 if it is analog */ \
    X(Number, NUMBER, true, true) \
    /* M3 and M4 on, M5 off. Analog: the speed S */ \
    X(Spindle, SPINDLE, false, true) \
    /* M4 on, M3 and M5 off */ \
    X(SpindleReverse, SPINDLE_REVERSE, false, false) \
    /* M7 on, M9 off */ \
    X(Mist, MIST, false, false) \
    /* M8 on, M9 off */ \
    X(Flood, FLOOD, false, false) \
    /* a pulse at each place of M69 */ \
    X(Places, PLACES, true, false)
// clang-format on

enum class OutputUse : std::uint8_t {
#define X(use, key, has_number, may_be_analog) use,
    LOCKSTEP_OUTPUT_USES(X)
#undef X
};

struct OutputUseRow {
    OutputUse use;
    bool has_number;
    bool may_be_analog;
};

inline constexpr std::array kOutputUses{
#define X(use, key, has_number, may_be_analog) OutputUseRow{OutputUse::use, has_number, may_be_analog},
    LOCKSTEP_OUTPUT_USES(X)
#undef X
};

constexpr const OutputUseRow& row_of(OutputUse use) { return pick_row(kOutputUses, use); }

/// The pulses of an analog output: they are longer for greater values.
struct PwmConfig {
    double hz = 0;
    double full_scale = 1;       // the value, such as S, at which it is always on
    bool follows_speed = false;  // after M4 it is in proportion to the speed of the path, and full at the feed
    bool operator==(const PwmConfig&) const = default;
};

struct OutputConfig {
    std::string name;
    std::string motor;      // whose device has it
    bool at_board = false;  // the motor is a board
    int channel = 0;        // of the device's digital outputs, or of its analog ones
    OutputUse use = OutputUse::Number;
    std::int32_t number = 0;         // if its use has one
    std::optional<PwmConfig> pwm;    // empty: a digital output
    bool inverted = false;           // it is on while its pin is low
    double pulse_us = 0;             // Places: how long each pulse is
    std::string at_speed;            // Spindle: the input that is closed while it has its speed; empty: there is none
    double spin_up_s = 0;            // Spindle: how long that takes, with at_speed at most; 0: a feed does not wait
    double simulated_spin_up_s = 0;  // Spindle: how long a simulated one takes to full speed; 0: there is none
    // Whether it keeps its level. Otherwise it goes off, and on again when a program goes on.
    bool stays_at_interruption = true;  // when motion ends before its path does
    bool stays_at_fault = false;        // and after an emergency stop
    bool stays_at_silence = false;      // when the device receives nothing from its process
    bool operator==(const OutputConfig&) const = default;

    bool is_analog() const { return pwm.has_value(); }
    bool makes_pulses() const { return use == OutputUse::Places; }
    /// It is digital, and on or off.
    bool has_level() const { return !is_analog() && !makes_pulses(); }
    /// Of its channel, in words of the outputs of its kind.
    std::uint16_t bit() const { return static_cast<std::uint16_t>(1U << channel); }
    /// Whether it keeps its level when a job ends before its end.
    bool stays_after(bool is_failure) const {
        return !makes_pulses() && stays_at_interruption && (stays_at_fault || !is_failure);
    }
};

/// Those of a motor's device.
inline std::vector<OutputConfig> outputs_of(std::span<const OutputConfig> outputs, std::string_view motor) {
    std::vector<OutputConfig> those;
    for (const OutputConfig& output : outputs) {
        if (output.motor == motor) { those.push_back(output); }
    }
    return those;
}

inline constexpr std::int32_t kMostAnalogNumbers = 16;   // of M67 and M68
inline constexpr std::int32_t kMostDigitalNumbers = 64;  // of M62 to M65

}  // namespace lockstep
