// Runs a text for a machine of nine axes at 0 and two tools, and keeps its actions.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/gcode/interpreter.hpp"
#include "core/gcode/text_lines.hpp"

namespace lockstep::gcode {

struct Ran {
    std::vector<Action> actions;
    std::optional<GcodeError> error;
    State state;

    template <typename Kind>
    std::vector<Kind> all() const {
        std::vector<Kind> found;
        for (const Action& action : actions) {
            if (const auto* one = std::get_if<Kind>(&action)) { found.push_back(*one); }
        }
        return found;
    }
    std::vector<std::string> messages() const {
        std::vector<std::string> found;
        for (const Event& event : all<Event>()) {
            if (event.kind == EventKind::Message) { found.push_back(event.text); }
        }
        return found;
    }
};

inline State two_tools() {
    State state;
    state.tools[1] = {.pocket = 1, .offset = {0, 0, 2}, .diameter = 3};
    state.tools[2] = {.pocket = 2, .offset = {0, 0, 5}, .diameter = 6};
    return state;
}

/// Runs the text up to its first error.
inline Ran run(std::string_view text, Setup setup = {}) {
    Ran ran;
    setup.program = text;
    Interpreter interpreter(std::move(setup), two_tools(),
                            [&](const Action& action, int) { ran.actions.push_back(action); });
    for_each_line(text, [&](std::string_view line, int number) {
        if (auto done = interpreter.take(line, number); !done) { ran.error = done.error(); }
        return !ran.error && !interpreter.ended();
    });
    if (!ran.error) {
        if (auto done = interpreter.finish(); !done) { ran.error = done.error(); }
    }
    ran.state = interpreter.state();
    return ran;
}

/// Where the axes stand at the end, in machine coordinates.
inline Point end_of(std::string_view text) {
    const Ran ran = run(text);
    EXPECT_FALSE(ran.error) << ran.error->line << ":" << ran.error->column << ": " << ran.error->message;
    return ran.state.machine;
}

}  // namespace lockstep::gcode
