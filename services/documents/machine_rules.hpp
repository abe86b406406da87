// What a valid configuration must satisfy, however it was written.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/machine.hpp"

namespace lockstep {

/// A key of the configuration: "tick_ns", "timing.slot_us", or "homing.pulloff_mm" of axis i. Empty: the block.
struct FieldPath {
    std::optional<std::size_t> axis;
    std::string key;
    bool operator==(const FieldPath&) const = default;
};

struct Problem {
    FieldPath field;
    std::string message;  // the value, the limit and the remedy
};

/// The machine's own keys, its timing and its network.
std::vector<Problem> machine_problems(const MachineConfig& machine);

/// The keys of one axis, and its name among the axes before it.
std::vector<Problem> axis_problems(const MachineConfig& machine, std::size_t axis);

}  // namespace lockstep
