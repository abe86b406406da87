// Reads G-code one line at a time, as a person or a sender gives it, while the machine runs the earlier lines.
//
// A session keeps what an interpreter keeps from line to line of a file: modes, parameters, offsets, the words of
// cycles and splines, the tool. So the lines of a file end at the same place as the file. M2 and M30 restore the modes
// with which a program begins; parameters and tool stay. A reset clears everything.
//
// A line is read by itself. Loops, branches, subroutines and cutter compensation need the lines after it, so they are
// refused. A call of a subroutine in a file of its name is one line, unless it probes.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/gcode.hpp"
#include "core/gcode/memory.hpp"
#include "core/machine.hpp"
#include "core/program_devices.hpp"

namespace lockstep {

/// The machine where a line begins.
struct SessionStart {
    std::vector<double> place_mm;  // one for each axis
    gcode::KeptValues values;
};

/// The effect of a line.
struct SessionLine {
    ProgramHead head;              // with the place where the line begins
    std::vector<Block> blocks;     // moves, dwells, pauses, events
    std::vector<GcodeNote> notes;  // skipped words, and messages
    std::vector<double> place_mm;  // of each axis after the blocks
    gcode::KeptValues values;      // after the line
    bool changes_values = false;
    bool ends_program = false;  // M2, M30
    bool awaits_touch = false;  // it ends with a probing move: before the next line, touched() must be called
    std::string message;        // for commit(): for the next pause
    bool awaits_speed = false;  // for commit(): a feed waits for the spindle
    gcode::Memory after;        // for commit()
};

class GcodeSession {
public:
    /// `setup`: its start and values are not used. `first_motion`: the motion of the first line without a motion word.
    GcodeSession(GcodeSetup setup, const MachineConfig& machine, int first_motion = gcode::kNoMotion);

    /// Clears everything: the next line is the first one.
    void reset();
    /// Keeps the session as it was.
    std::expected<SessionLine, GcodeError> read(std::string_view line, const SessionStart& start) const;
    /// Continues behind a line that read() has returned. Takes its `after`.
    void commit(SessionLine& line);
    /// Gives how the probing move of the last line ended.
    void touched(const ProbeTouch& touch);
    /// Restores the modes with which a program begins.
    void end_program();
    /// Sets the modes of spindle and coolant to what is switched on.
    void set_devices(const ProgramDevices& devices);

    /// The state behind the last line, with the offsets that were in force there.
    const gcode::State& state() const { return memory_.state; }
    /// The offsets with which the next line begins.
    gcode::Offsets offsets(const gcode::KeptValues& values) const;

private:
    gcode::Memory memory_at(const gcode::KeptValues& values) const;
    std::vector<double> begin_at(const std::vector<double>& place_mm, gcode::State& state) const;

    GcodeSetup setup_;
    MachineConfig machine_;
    int first_motion_;
    gcode::Point park_;
    gcode::Memory memory_;
    std::string message_;                          // the last one since the last pause
    bool awaits_speed_ = false;                    // the next feed waits for the spindle
    std::optional<std::vector<double>> place_mm_;  // exact, where the last line ends
    std::optional<gcode::KeptValues> values_;      // that memory_ contains
};

/// The words of the modes: "G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0". F and S are the program's numbers.
std::vector<std::string> active_words(const gcode::State& state);

}  // namespace lockstep
