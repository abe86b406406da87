// Scenarios for tests: a machine of two axes, and the text that follows it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

inline const std::string kMachine =
    "machine { name: \"stage\"\n"
    "  axis { name: \"X\" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 100 max_accel_mm_s2: 1000\n"
    "    position_min_mm: 0 position_max_mm: 100 }\n"
    "  axis { name: \"Y\" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 100 max_accel_mm_s2: 1000\n"
    "    position_min_mm: 0 position_max_mm: 100 } }\n";

/// `text` begins on line 6.
inline std::string with_machine(const std::string& text) { return kMachine + text; }

/// A valid scenario with a homing step, followed by `text`.
inline std::string whole(const std::string& text) {
    return with_machine("shows: \"something\"\nstep { home {} }\n" + text);
}

/// The same of the example with two motors on Y.
inline std::string of_gantry(const std::string& text) {
    return "machine_file: \"" LOCKSTEP_SCENARIOS
           "/../examples/gantry.textproto\"\nshows: \"something\"\nstep { home {} }\n" +
           text;
}

/// All errors as "line:column: message", one per line. Empty if there are none.
inline std::string errors_of(const std::string& text) {
    const auto scenario = parse_scenario(text, "/tmp/of-a-test.textproto");
    std::string errors;
    if (scenario) { return errors; }
    for (const Diagnostic& error : scenario.error()) {
        errors += std::to_string(error.line) + ":" + std::to_string(error.column) + ": " + error.message + "\n";
    }
    return errors;
}

inline Scenario parsed(const std::string& text) {
    auto scenario = parse_scenario(text, "/tmp/of-a-test.textproto");
    EXPECT_TRUE(scenario) << errors_of(text);
    return scenario ? *std::move(scenario) : Scenario{};
}

}  // namespace lockstep::scenario
