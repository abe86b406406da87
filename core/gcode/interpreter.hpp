// The interpreter of G-code: takes the lines of a program one by one and emits their actions.
//
// The same lines, setup and state give the same actions and the same state. Loops and subroutines are stored until
// their end has been read. All other lines are run at once, so a program may have any length.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/gcode/flow/call_stack.hpp"
#include "core/gcode/flow/line_count.hpp"
#include "core/gcode/flow/stored_bodies.hpp"
#include "core/gcode/flow/used_labels.hpp"
#include "core/gcode/line_words.hpp"
#include "core/gcode/memory.hpp"
#include "core/gcode/run/context.hpp"
#include "core/gcode/setup.hpp"
#include "core/gcode/state.hpp"
#include "core/gcode/system_parameters.hpp"

namespace lockstep::gcode {

class Interpreter {
public:
    Interpreter(Setup setup, State state, Sink sink);
    /// Continues where another interpreter was between two lines.
    Interpreter(Setup setup, Memory memory, Sink sink);
    Interpreter(const Interpreter&) = delete;
    Interpreter& operator=(const Interpreter&) = delete;

    /// Takes a line of the text, without its line end. Returns its first error. Effects of the words before it remain.
    Result take(std::string_view text, int number);
    /// Ends the text. Returns an error if a loop or a subroutine is not closed.
    Result finish();
    /// The O-word whose end has not been read yet, such as "o100 while"; nullopt if there is none.
    std::optional<std::string> open_word() const { return bodies_.open_word(); }
    /// True after a probing move, if Setup::awaits_touches. Before the next line, go_on_behind() must be called.
    bool awaits_touch() const { return awaits_touch_; }
    /// Gives the touch that is awaited, and runs the rest of a loop or a subroutine, up to the next probing move.
    Result go_on_behind(const Touch& touch);
    /// The probing move is in a loop or a subroutine, which has not ended.
    bool is_within_body() const { return !stack_.is_empty(); }
    /// True after M2, M30, the second % or stop(). Later lines are ignored.
    bool ended() const { return ended_; }
    /// Ends the program behind the present line, also if that is in a loop.
    void stop() { ended_ = true; }

    const State& state() const { return state_; }
    /// For an interpreter that continues with the next line. Call between two lines.
    Memory memory() const;
    /// The last line that was run, and its block, for messages.
    const Line& line() const { return line_; }
    const LineWords& block() const { return block_; }

private:
    Result take_line(std::string_view text);
    Result take_o_word(Reader& reader, std::string_view text);
    Result store(const OWord& word, std::string_view text);
    Result call(Reader& reader, const OWord& word);
    Result run_bodies();
    Result run_stored(const KeptLine& kept);
    Result run_plain(Reader& reader);
    Context context();

    Setup setup_;
    State state_;
    Sink sink_;
    Line line_;
    LineWords block_;
    SystemParameters system_;
    Parameters parameters_;
    StoredBodies bodies_;
    CallStack stack_;
    UsedLabels labels_;
    LineCount count_;
    int program_line_ = 0;  // the last line taken of the program itself
    bool begun_ = false;
    bool ended_ = false;
    bool awaits_touch_ = false;
};

}  // namespace lockstep::gcode
