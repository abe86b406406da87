// Orders to measure with a probe, and to keep what was measured. Pure.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "clients/session/measuring/measure_options.hpp"
#include "clients/session/move_program.hpp"
#include "clients/web/request/problem.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

struct MeasureOrder {
    std::variant<ProbeOptions, MeasureOptions> what;  // one touch, or several that a subroutine makes
};

/// Where the newest measurement is kept: in a coordinate system, or as the length of a tool.
struct KeepOrder {
    std::string system;       // its zero, or its rotation
    std::optional<int> tool;  // its length
    double reads_mm = 0;      // what the measured axes read in the system at the measured place
};

std::optional<MeasureOrder> read_measure(const Json& body, std::optional<Problem>& problem);
std::optional<KeepOrder> read_keep(const Json& body, std::optional<Problem>& problem);

}  // namespace lockstep::web
