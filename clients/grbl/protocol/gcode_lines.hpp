// Reads lines of G-code with the same parser as files. Each line becomes blocks for the machine, and changes modes and
// offsets.
//
// A line is read by itself. Loops, subroutines and cutter compensation need several lines, so they work only in files.
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

/// The effect of a line.
struct LineEffect {
    std::vector<Block> blocks;                // moves, dwells, pauses
    std::vector<double> place_mm;             // of each axis after the blocks
    double seconds = 0;                       // approximate duration of the blocks
    std::optional<std::int32_t> sender_line;  // its N word
    std::vector<std::string> notes;           // ignored words, and messages
    std::optional<gcode::KeptValues> values;  // the offsets if it changes them
    bool ends_program = false;                // M2, M30
    bool rests_before = false;                // all earlier lines must be run first, as in grbl
    bool rests_behind = false;                // answered only after it was run: a dwell, a pause
    // For GcodeLines only:
    gcode::Modal modal;
    gcode::Point tool_offset{};
    int selected_tool = 0;
    int tool = 0;
};

class GcodeLines {
public:
    explicit GcodeLines(const MachineConfig& machine);

    /// Restores the modes with which every connection begins. Keeps the offsets.
    void reset();
    /// `place_mm`: the position of each axis where the line begins. Changes no mode.
    std::expected<LineEffect, Refused> read(std::string_view line, const std::vector<double>& place_mm,
                                            const gcode::KeptValues& values) const;
    /// Applies the modes that the line leaves.
    void commit(const LineEffect& effect);

    /// Sets the modes of spindle and coolant to off. Returns whether lines had switched one of them on.
    bool switch_off();

    /// "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0".
    std::string modes_text() const;
    bool inches() const { return modal_.inches; }
    bool relative() const { return modal_.relative; }
    /// The offset of the work's zero, by axis.
    std::vector<double> offset_mm(const gcode::KeptValues& values) const;
    /// The length offset of the tool, along Z.
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
