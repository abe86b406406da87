// The interpreter of G-code: takes the lines of a program one by one and emits their actions.
//
// The same lines, setup and state give the same actions and the same state. Loops and subroutines are stored until
// their end has been read. All other lines are run at once, so a program may have any length.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/gcode/flow/body.hpp"
#include "core/gcode/line_words.hpp"
#include "core/gcode/memory.hpp"
#include "core/gcode/run/context.hpp"
#include "core/gcode/setup.hpp"
#include "core/gcode/state.hpp"

namespace lockstep::gcode {

class Interpreter : private SystemValues {
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
    std::optional<std::string> open_word() const { return recorder_.open_word(); }
    /// True after a probing move, if Setup::awaits_touches. Before the next line, go_on_behind() must be called.
    bool awaits_touch() const { return awaits_touch_; }
    /// Gives the touch that is awaited, and runs the rest of a loop or a subroutine, up to the next probing move.
    Result go_on_behind(const Touch& touch);
    /// The probing move is in a loop or a subroutine, which has not ended.
    bool is_within_body() const { return !levels_.empty(); }
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
    struct Level {
        const Body* body = nullptr;
        std::size_t next = 0;
        bool is_call = false;
        KeptModes kept;
        std::map<std::size_t, double> repeats;  // remaining ones, by the loop's first line
    };

    std::optional<double> numbered(int number) const override;
    std::optional<double> named(std::string_view name) const override;
    std::optional<double> numbered_tool(int number) const;

    Result take_line(std::string_view text);
    Result take_percent();
    bool skip_head(Reader& reader) const { return skip_head(line_, reader); }
    bool skip_head(const Line& line, Reader& reader) const;
    Result do_plain(Reader& reader);
    Result assign();
    Context context();
    Result keep(const OWord& word, std::string_view text);
    Result do_o_word(Reader& reader, const OWord& word);
    Result close_body();

    // Kept lines: loops.cpp
    Result run_on();
    Result do_frames();
    Result do_kept(Level& level, const KeptLine& line);
    Result do_flow(Level& level, std::size_t at, Reader& reader);
    Result note_opening(const OWord& word);
    Result choose_branch(Level& level);
    Result go_round(Level& level, std::size_t at, Reader& reader);
    Result count_lines();

    // Subroutines: calls.cpp
    Result call(Reader& reader, const OWord& word);
    Result leave(Level& level, Reader& reader);
    Result find_subroutine(const OWord& word);
    Result load(const OWord& word, std::string_view text);
    Result load_later(const OWord& word);
    struct SubroutineText;
    SubroutineText text_behind(const std::string& label);
    void find_beginnings();
    std::optional<GcodeError> keep_subroutines(const SubroutineText& source);
    void end_call();
    void unwind();
    std::unexpected<GcodeError> error(std::size_t place, std::string message) const;
    Result rest_is_empty(Reader& reader) const;

    Setup setup_;
    State state_;
    Sink sink_;
    Parameters parameters_;
    Line line_;
    LineWords block_;
    KeptModes kept_;  // of the program itself
    Recorder recorder_;
    std::map<std::string, Body, std::less<>> subroutines_;
    std::set<std::string, std::less<>> called_early_;  // subroutines that are behind their first call
    /// A line of the program that begins a subroutine, and the place of its text in the program.
    struct Beginning {
        int line;
        std::size_t place;
    };
    std::map<std::string, std::vector<Beginning>, std::less<>> beginnings_;  // by label
    bool has_beginnings_ = false;
    struct Opening {
        Keyword keyword;
        int line;
    };
    /// The keyword that opened a branch or a loop, by its label. Each subroutine has labels of its own.
    std::map<std::pair<std::string, std::string>, Opening> openings_;
    int program_line_ = 0;  // the last line taken of the program itself
    std::vector<Level> levels_;
    std::optional<Body> running_;  // the loop or branch of the program itself that is being run
    int calls_ = 0;
    std::int64_t repeated_lines_ = 0;  // lines of loops and subroutines that were run, and their actions
    std::int64_t idle_lines_ = 0;      // since the last action
    std::size_t kept_lines_ = 0;
    double returned_ = 0;
    bool has_returned_ = false;
    bool begun_ = false;
    bool ended_ = false;
    bool awaits_touch_ = false;
};

}  // namespace lockstep::gcode
