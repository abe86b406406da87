// What the words of programs have switched: the state of spindle, coolant, tool and outputs.
#pragma once

#include <cstdint>

#include "core/program.hpp"

namespace lockstep {

struct ProgramDevices {
    enum class Spindle : std::uint8_t { Stopped, Forward, Reverse };

    Spindle spindle = Spindle::Stopped;
    double spindle_rpm = 0;  // asked for; meaningful while it turns
    bool mist = false;
    bool flood = false;
    std::int32_t tool = 0;      // in the spindle; 0: none is known
    std::uint64_t outputs = 0;  // bit n: output n is on; those beyond 63 are not kept
    bool operator==(const ProgramDevices&) const = default;

    void apply(const ProgramEvent& event);
};

}  // namespace lockstep
