// An input of the machine: a pin of a motor's device, or a board's, that is wired to something other than the motor's
// own switches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumeration.hpp"
#include "core/faults.hpp"

namespace lockstep {

/// One row for each use: its name in reports, what it means that the input is closed, its letter in grbl's Pn, and the
/// refusal of motions while it is closed. An input with a refusal holds the machine: it comes to rest on its path and
/// stays there. The order is that of idl/proto/machine.proto.
// clang-format off
#define LOCKSTEP_INPUT_USES(X) \
    /* the device stops by itself, and the whole machine stops */ \
    X(EmergencyStop, "emergency-stop", "emergency stop", 'E', None) \
    X(Door, "door", "door open", 'D', DoorOpen) \
    /* programs may read it */ \
    X(Program, "program", "", 0, None) \
    /* moves end where it touches */ \
    X(Probe, "probe", "", 'P', None) \
    /* the switch of axes whose motors are not those of its device alone */ \
    X(Home, "home", "", 0, None) \
    /* the switches at the ends of a motor's way, or of an axis's */ \
    X(LimitMin, "limit-min", "limit switch", 0, None) \
    X(LimitMax, "limit-max", "limit switch", 0, None)
// clang-format on

enum class InputUse : std::uint8_t {
#define X(use, name, closed, letter, refusal) use,
    LOCKSTEP_INPUT_USES(X)
#undef X
};

struct InputUseRow {
    InputUse use;
    std::string_view name;
    std::string_view closed;  // empty: that is nothing special
    char letter;              // 0: none
    FaultCode refusal;        // None: it does not hold the machine

    constexpr bool holds() const { return refusal != FaultCode::None; }
};

inline constexpr std::array kInputUses{
#define X(use, name, closed, letter, refusal) InputUseRow{InputUse::use, name, closed, letter, FaultCode::refusal},
    LOCKSTEP_INPUT_USES(X)
#undef X
};

constexpr const InputUseRow& row_of(InputUse use) { return pick_row(kInputUses, use); }
constexpr std::string_view name_of(InputUse use) { return row_of(use).name; }

/// The effect of a probe that touches during a motion other than a probing move with it.
enum class TouchInMotion : std::uint8_t {
    Nothing,
    Hold,   // the machine comes to rest on its path, as with a hold
    Fault,  // the same, and the machine is in fault
};

/// Inputs 0, 1 and 2 of a motor's device have its switches: the limit switches and the home switch. A board has none.
inline constexpr int kSwitchInputs = 3;
inline constexpr std::array kSwitchUses{InputUse::LimitMin, InputUse::LimitMax, InputUse::Home};
static_assert(kSwitchUses.size() == kSwitchInputs);

struct InputConfig {
    std::string name;
    std::string motor;      // whose device has the pin
    bool at_board = false;  // the motor is a board
    int channel = kSwitchInputs;
    InputUse use = InputUse::Program;
    bool active_low = false;                       // closed while the pin is low
    double debounce_ms = 1;                        // for how long the pin must keep its level until the input follows
    std::optional<int> number;                     // under which programs know it: Program, Probe
    double max_overshoot_mm = kUsualOvershoot_mm;  // how far a move may go on behind the touch: Probe, Home, see axis
    TouchInMotion at_touch_in_motion = TouchInMotion::Nothing;  // Probe
    std::string wire;  // the inputs of one wire, at different devices, are one switch that all of them see: Probe
    double simulated_bounce_ms = 0;  // for how long a simulated contact bounces after it changes
    // LimitMin, LimitMax: the axis at whose end the switch is, if the coordinator stops the machine. Empty: the device
    // stops its motor.
    std::string axis;

    static constexpr double kUsualOvershoot_mm = 1;
    bool operator==(const InputConfig&) const = default;

    bool is_limit() const { return use == InputUse::LimitMin || use == InputUse::LimitMax; }
    /// The device does not stop the motor, but the coordinator the machine.
    bool is_limit_by_message() const { return is_limit() && !axis.empty(); }
    bool is_limit_of_device() const { return is_limit() && axis.empty(); }
};

/// The first input of this use that programs know by this number; null if there is none.
inline const InputConfig* input_numbered(std::span<const InputConfig> inputs, InputUse use, int number) {
    for (const InputConfig& input : inputs) {
        if (input.use == use && input.number == number) { return &input; }
    }
    return nullptr;
}

/// Whether the inputs are of several probes, so that a program must choose one of them by its number.
inline bool has_several_probes(std::span<const InputConfig> inputs) {
    std::optional<int> first;
    for (const InputConfig& input : inputs) {
        if (input.use != InputUse::Probe) { continue; }
        if (first && input.number != first) { return true; }
        first = input.number;
    }
    return false;
}

/// Programs of the coordinator name a switch as a probe of this number, by its place in the machine's file. Programs of
/// clients name probes by lower ones.
inline constexpr int kFirstHomeInput = 1000;
constexpr int number_of_home_input(std::size_t input) { return kFirstHomeInput + static_cast<int>(input); }

/// The inputs of a Probe with this number, in the order of the machine's file.
inline std::vector<const InputConfig*> inputs_of_probe(std::span<const InputConfig> inputs, int number) {
    std::vector<const InputConfig*> found;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const bool is_probe = inputs[i].use == InputUse::Probe && inputs[i].number == number;
        const bool is_switch = inputs[i].use == InputUse::Home && number == number_of_home_input(i);
        if (is_probe || is_switch) { found.push_back(&inputs[i]); }
    }
    return found;
}

}  // namespace lockstep
