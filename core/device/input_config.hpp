// An input of the machine: a pin of a motor's device, or a board's, that is wired to something other than the motor's
// own switches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lockstep {

enum class InputUse : std::uint8_t {
    EmergencyStop,  // the device stops by itself, and the whole machine stops
    Door,           // the machine comes to rest on its path and stays there
    Program,        // programs may read it
    Probe,          // moves end where it touches
    Home,           // the switch of axes whose motors are not those of its device alone
};

constexpr std::string_view name_of(InputUse use) {
    switch (use) {
        case InputUse::EmergencyStop: return "emergency-stop";
        case InputUse::Door: return "door";
        case InputUse::Probe: return "probe";
        case InputUse::Home: return "home";
        case InputUse::Program: break;
    }
    return "program";
}

/// Inputs 0, 1 and 2 of a motor's device have its switches: the limit switches and the home switch. A board has none.
inline constexpr int kSwitchInputs = 3;

struct InputConfig {
    std::string name;
    std::string motor;      // whose device has the pin
    bool at_board = false;  // the motor is a board
    int channel = kSwitchInputs;
    InputUse use = InputUse::Program;
    bool active_low = false;                       // closed while the pin is low
    double debounce_ms = 1;                        // for how long the pin must keep its level until the input follows
    std::optional<int> number;                     // under which programs know it: Program, Probe
    double max_overshoot_mm = kUsualOvershoot_mm;  // how far a move may go on behind the touch: Probe, Home

    static constexpr double kUsualOvershoot_mm = 1;
    bool operator==(const InputConfig&) const = default;
};

/// The input of this use that programs know by this number; null if there is none.
inline const InputConfig* input_numbered(std::span<const InputConfig> inputs, InputUse use, int number) {
    for (const InputConfig& input : inputs) {
        if (input.use == use && input.number == number) { return &input; }
    }
    return nullptr;
}

/// Programs of the coordinator name a switch as a probe of this number, by its place in the machine's file. Programs of
/// clients name probes by lower ones.
inline constexpr int kFirstHomeInput = 1000;
constexpr int number_of_home_input(std::size_t input) { return kFirstHomeInput + static_cast<int>(input); }

/// The input of a Probe with this number; null if there is none.
inline const InputConfig* touch_input_numbered(std::span<const InputConfig> inputs, int number) {
    if (number < kFirstHomeInput) { return input_numbered(inputs, InputUse::Probe, number); }
    const auto place = static_cast<std::size_t>(number - kFirstHomeInput);
    return place < inputs.size() && inputs[place].use == InputUse::Home ? &inputs[place] : nullptr;
}

}  // namespace lockstep
