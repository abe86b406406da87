// Lines of G-code that move nothing: modes, coordinate systems and offsets. What they leave is the state of the parser
// that $G reports.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/grbl/protocol/errors.hpp"
#include "clients/grbl/protocol/machine_view.hpp"
#include "core/gcode/state.hpp"
#include "core/machine.hpp"

namespace lockstep::grbl {

/// What a line does, apart from modes.
struct LineEffect {
    bool moves = false;                       // motion, or what only a program can do; modes are as before
    std::optional<gcode::KeptValues> values;  // offsets that it changed
    bool ends_program = false;                // M2, M30
};

class LineModes {
public:
    explicit LineModes(const MachineConfig& machine);

    /// The modes that every connection and every reset begins with; offsets stay.
    void reset();
    std::expected<LineEffect, Refused> take(std::string_view line, const MachineView& view);

    /// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0".
    std::string modes_text() const;
    bool inches() const { return modal_.inches; }
    bool relative() const { return modal_.relative; }
    /// Of the work's zero, by axis.
    std::vector<double> offset_mm(const gcode::KeptValues& values) const;

private:
    gcode::State state_of(const MachineView& view) const;

    MachineConfig machine_;
    std::string letters_;
    gcode::Modal modal_;
};

}  // namespace lockstep::grbl
