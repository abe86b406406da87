// The state of spindle, coolant, tool and outputs, as the words of programs have set it.
#pragma once

#include <cstdint>
#include <vector>

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
    /// The numbers of the outputs that are on, rising.
    std::vector<std::uint32_t> outputs_on() const;
};

}  // namespace lockstep
