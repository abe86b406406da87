// How a device is wired and what its outputs do by themselves: written once to the device when an axis finds it.
#pragma once

#include <array>
#include <cstdint>

#include "core/hardware/output_change.hpp"
#include "core/units.hpp"

namespace lockstep {

/// The levels to which the device itself brings outputs when they must be safe.
struct SafeOutputs {
    SetDigital digital;
    std::uint8_t analog_off = 0;  // the analog outputs that fall to 0; output n is bit n
    bool operator==(const SafeOutputs&) const = default;
};

struct DeviceSetup {
    // Pulses, in nanoseconds. A step's edge comes a constant time after its tick.
    std::int64_t step_width_ns = 0;       // 0: as the device does without being told
    std::int64_t direction_setup_ns = 0;  // from a change of direction to the next edge
    std::int64_t direction_hold_ns = 0;   // from an edge to the next change of direction
    Ticks enable_wait;                    // from enabling the motor to its first run
    bool step_inverted = false;
    bool direction_inverted = false;
    bool enable_inverted = false;

    // Inputs; input n is bit n.
    std::uint32_t inputs_inverted = 0;          // these are closed while their pin is low
    std::uint32_t limit_min = 1;                // while one of them is closed, no step goes backward
    std::uint32_t limit_max = 2;                // while one of them is closed, no step goes forward
    std::uint32_t home = 4;                     // the home switch: any of them is closed
    std::uint32_t stop = 0;                     // while one of them is closed, no step is made and no run begins
    std::array<Ticks, kMostInputs> debounce{};  // for how long a pin must keep its level until the input follows

    // Outputs.
    std::uint16_t outputs_inverted = 0;  // these are on while their pin is low
    SafeOutputs at_cut;                  // when a run ends in any other way than by its last frame
    SafeOutputs at_silence;              // when the host is silent
    bool disable_at_silence = false;     // the motor, too
    Ticks silence;                       // the host is silent if it shows no new beat for so long; 0: never
    std::uint16_t compare_outputs = 0;   // that show the pulses of ComparePosition
    Ticks compare_pulse{1};
    std::array<std::int64_t, kMostAnalogOutputs> pwm_period_ns{};  // of analog outputs; 0: none is made

    bool operator==(const DeviceSetup&) const = default;
};

}  // namespace lockstep
