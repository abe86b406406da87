// Lines of G-code, read by the same parser as files: each becomes blocks for the machine, and changes modes and
// offsets.
//
// A line is read by itself. Loops, subroutines and cutter compensation need the lines around it: a file has them.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/grbl/protocol/errors.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/state.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::grbl {

/// What a line does.
struct LineEffect {
    std::vector<Block> blocks;                // moves, dwells, pauses
    std::vector<double> place_mm;             // of each axis behind them
    double seconds = 0;                       // that the blocks take, about
    std::int32_t sender_line = 0;             // its N word; 0: none
    std::vector<std::string> notes;           // words that were passed over, and messages
    std::optional<gcode::KeptValues> values;  // offsets that it changes
    bool ends_program = false;                // M2, M30
    bool rests_before = false;                // all lines before it are run first, as in grbl
    bool rests_behind = false;                // it is answered when it was run: a dwell, a pause
    // For GcodeLines alone:
    gcode::Modal modal;
    gcode::Point tool_offset{};
    int selected_tool = 0;
    int tool = 0;
};

class GcodeLines {
public:
    explicit GcodeLines(const MachineConfig& machine);

    /// The modes that every connection and every reset begins with; offsets stay.
    void reset();
    /// `place_mm`: of each axis where the line begins. Changes nothing.
    std::expected<LineEffect, Refused> read(std::string_view line, const std::vector<double>& place_mm,
                                            const gcode::KeptValues& values) const;
    /// The line is done: the modes are as it leaves them.
    void commit(const LineEffect& effect);

    /// Spindle and coolant are off from now on. Returns whether lines had switched one of them on.
    bool switch_off();

    /// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0".
    std::string modes_text() const;
    bool inches() const { return modal_.inches; }
    bool relative() const { return modal_.relative; }
    /// Of the work's zero, by axis.
    std::vector<double> offset_mm(const gcode::KeptValues& values) const;
    /// Of the tool, along Z.
    double tool_length_mm() const { return tool_offset_[2]; }

private:
    gcode::State state_at(const std::vector<double>& place_mm, const gcode::KeptValues& values) const;
    double seconds_of(const std::vector<Block>& blocks, const std::vector<double>& from_mm) const;

    MachineConfig machine_;
    GcodeSetup setup_;
    gcode::Modal modal_;
    gcode::Point tool_offset_{};
    int selected_tool_ = 0;
    int tool_ = 0;  // in the spindle
};

}  // namespace lockstep::grbl
