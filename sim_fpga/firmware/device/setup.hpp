// How a motor's device is wired and what its outputs do by themselves, from the words that the host wrote.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/abilities.hpp"
#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

/// Levels to which the device brings outputs when they must be safe. Output n is bit n.
struct SafeOutputs {
    std::uint16_t levels = 0;
    std::uint16_t mask = 0;
    std::uint8_t analog_off = 0;
};

/// Names and meanings are those of the register map. A setup before the first has limit and home switches at inputs 0,
/// 1 and 2, like a device of the simulation.
struct Setup {
    // Of pulses, in the map's unit.
    std::uint64_t step_width = 0;
    std::uint64_t direction_setup = 0;
    std::uint64_t direction_hold = 0;
    std::uint64_t longest_pwm_period = 0;
    std::uint64_t pwm_period[kMostAnalog]{};
    std::uint64_t inverted = 0;
    std::uint16_t pwm_channels = 0;
    std::uint32_t debounced = 0;
    std::int64_t enable_ticks = 0;
    std::uint32_t inputs_inverted = 0;
    std::uint32_t limit_min = 1;
    std::uint32_t limit_max = 2;
    std::uint32_t home = 4;
    std::uint32_t stop = 0;
    std::int64_t debounce[kMostInputs]{};
    std::uint16_t outputs_inverted = 0;
    SafeOutputs at_cut;
    SafeOutputs at_silence;
    bool is_disabled_at_silence = false;
    std::int64_t silence_ticks = 0;
    std::uint16_t compare_outputs = 0;
    std::int64_t compare_ticks = 1;
};

Setup load_setup(const Words& words);
/// Whether the device can do what the setup asks for.
bool is_within(const Abilities& abilities, const Setup& setup);

}  // namespace lockstep::firmware
