// Reads lines of G-code with the same interpreter as files. Each line becomes blocks for the machine, and changes
// modes, parameters and offsets.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/grbl/protocol/errors.hpp"
#include "core/gcode/session/gcode_session.hpp"
#include "core/program.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep::grbl {

/// The effect of a line.
struct LineEffect {
    SessionLine line;
    double seconds = 0;                       // approximate duration of the blocks
    std::optional<std::int32_t> sender_line;  // its N word
    bool rests_before = false;                // all earlier lines must be run first, as in grbl
    bool rests_behind = false;                // answered only after it was run: a dwell, a pause
};

class GcodeLines {
public:
    explicit GcodeLines(const MachineSetup& machine);

    /// Restores the state with which every connection begins. Keeps the offsets.
    void reset() { session_.reset(); }
    /// `place_mm`: the position of each axis where the line begins. Changes no mode.
    std::expected<LineEffect, Refused> read(std::string_view line, const std::vector<double>& place_mm,
                                            const gcode::KeptValues& values) const;
    /// Applies the modes and parameters that the line leaves.
    void commit(SessionLine& line) { session_.commit(line); }
    /// Gives how the probing move of the last line ended.
    void touched(const ProbeTouch& touch) { session_.touched(touch); }

    /// Sets the modes of spindle and coolant to off. Returns whether lines had switched one of them on.
    bool switch_off();

    /// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0".
    std::string modes_text() const;
    bool inches() const { return session_.state().modal.inches; }
    bool relative() const { return session_.state().modal.relative; }
    /// The offset of the work's zero, by axis.
    std::vector<double> offset_mm(const gcode::KeptValues& values) const;
    /// The length offset of the tool, along Z.
    double tool_length_mm() const { return session_.state().offsets.tool[2]; }

private:
    bool rests_before(const SessionLine& line) const;
    double seconds_of(const SessionLine& line) const;

    MachineSetup machine_;
    GcodeSession session_;
};

}  // namespace lockstep::grbl
