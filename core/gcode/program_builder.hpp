// Makes a motion program of what an interpreter hands out: checks travel, cuts curves, and applies the machine's rules
// to words that move nothing.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/gcode/gcode.hpp"
#include "core/gcode/interpreter.hpp"
#include "core/gcode/modal_state.hpp"

namespace lockstep::gcode {

/// The letters that call the setup's axes; axes of longer names have none.
std::string axis_letters(const GcodeSetup& setup);
/// The interpreter's setup and the state that a program of this machine begins with.
Setup interpreter_setup(const GcodeSetup& setup);
State start_state(const GcodeSetup& setup);
/// Where the axes park, in the order of kAxisLetters.
Point park_place(const GcodeSetup& setup);
/// The axis of a G-code letter's place among kAxisLetters, for each axis of the setup; none for longer names.
std::vector<std::optional<std::size_t>> axis_places(const GcodeSetup& setup);

/// An F so small is a mistake in the units. Of the block that the interpreter has just done.
std::optional<GcodeError> slow_feed(const Interpreter& interpreter);

ModalState modal_of(const State& now, const GcodeSetup& setup);

class ProgramBuilder {
public:
    explicit ProgramBuilder(const GcodeSetup& setup);

    /// `interpreter` is at the block that the action is of; it gives the places of words in errors.
    void take(const Action& action, int line, const Interpreter& interpreter);
    /// What was wrong with the actions since the last call.
    std::vector<GcodeError> take_errors() { return std::exchange(errors_, {}); }

    ProgramHead head() const { return program_.head(); }
    /// Those made since the last call.
    std::vector<lockstep::Block> take_blocks() { return std::exchange(program_.blocks, {}); }
    std::vector<GcodeNote> take_notes() { return std::exchange(notes_, {}); }

    GcodeReading reading() && { return {std::move(program_), std::move(notes_), {}}; }

private:
    void move(const Point& target, double feed, bool rapid);
    double within_travel(std::size_t axis, double mm);
    double feed_along_path(const std::vector<double>& target, double feed) const;
    void event(const Event& event);
    void unassigned(WordRule rule, const std::string& what, const std::string& key);
    void note(const std::string& kind, const std::string& text);
    void append(decltype(lockstep::Block::action) action);
    void fail(std::size_t axis, const std::string& message);
    void fail(const std::string& message);

    const GcodeSetup& setup_;
    std::vector<std::optional<std::size_t>> places_;
    Program program_;
    std::vector<GcodeNote> notes_;
    std::set<std::string> noted_;
    std::vector<double> position_;
    Point at_{};
    std::vector<GcodeError> errors_;
    int line_ = 0;
    std::set<std::size_t> outside_;  // axes that this line's errors name
    const Interpreter* interpreter_ = nullptr;
};

}  // namespace lockstep::gcode
