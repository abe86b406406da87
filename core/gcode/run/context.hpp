// The data of the steps of a block's execution.
#pragma once

#include <optional>
#include <string>

#include "core/gcode/line_words.hpp"
#include "core/gcode/motion.hpp"
#include "core/gcode/setup.hpp"
#include "core/gcode/state.hpp"

namespace lockstep::gcode {

struct Context {
    const Setup& setup;
    State& state;
    Parameters& parameters;
    const Sink& sink;
    const Line& line;
    LineWords& block;
    KeptModes& kept;
    int motion = kNoMotion;     // the motion that this block runs, times ten
    bool ended = false;         // M2, M30
    bool awaits_touch = false;  // the block ends with a probing move whose touch is not known yet

    /// An error at a word: the word's text and `what`.
    std::unexpected<GcodeError> refuse(char letter, const std::string& what) const;
    std::unexpected<GcodeError> refuse(Group group, const std::string& what) const;
    /// An error at the motion's word, or at the block's first axis word.
    std::unexpected<GcodeError> refuse_motion(const std::string& what) const;

    /// Returns an error if cutter compensation is on, because the word cannot be used with it.
    Result refuse_compensated(Group group) const;
    bool is_compensated() const { return state.modal.side != Side::None; }

    /// Emits an action behind the motion that cutter compensation keeps waiting, if there is one.
    void emit(const Action& action) const;
    void event(EventKind kind, int index = 0, double value = 0) const { emit(Event{kind, index, value, {}}); }

    /// Converts a length or an angle from the program's units to mm or degrees.
    double length(double value) const { return state.modal.inches ? value * kMillimetresPerInch : value; }
    double place(std::size_t axis, double value) const { return is_turning(axis) ? value : length(value); }
    /// The block's word for an axis, in mm or degrees.
    std::optional<double> axis_word(std::size_t axis) const;
    /// The target of the block's axis words, in the program's coordinates.
    Point target() const;

    static constexpr double kMillimetresPerInch = 25.4;
};

/// A word's value if it is a whole number.
std::optional<int> whole(double value);

}  // namespace lockstep::gcode
