// Makes a motion program from the actions of an interpreter: checks travel, cuts curves, and applies the machine's
// rules to words that move no axis.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/gcode/built_blocks.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/interpreter.hpp"
#include "core/gcode/modal_state.hpp"

namespace lockstep::gcode {

/// The letters of the setup's axes. Axes with longer names have none.
std::string axis_letters(const GcodeSetup& setup);
/// The interpreter's setup and the state that a program of this machine begins with.
/// `text`: see Setup::program.
Setup interpreter_setup(const GcodeSetup& setup, std::string_view text = {});
State start_state(const GcodeSetup& setup);
/// The park position, in the order of kAxisLetters.
Point park_place(const GcodeSetup& setup);
/// For each axis of the setup the index of its letter in kAxisLetters; none for longer names.
std::vector<std::optional<std::size_t>> axis_places(const GcodeSetup& setup);

/// Returns an error if F in the interpreter's last block is so small that its units must be wrong.
std::optional<GcodeError> slow_feed(const Interpreter& interpreter);

ModalState modal_of(const State& now, const GcodeSetup& setup);

class ProgramBuilder {
public:
    explicit ProgramBuilder(const GcodeSetup& setup);

    /// Sets the devices' state before the first action. The program's end also switches off devices that are on then.
    /// `message`: the last message before, for the next pause. `awaits_speed`: as awaits_speed() before.
    void begin(const Modal& modal, std::string message = {}, bool awaits_speed = false) {
        message_ = std::move(message);
        awaits_speed_ = awaits_speed;
        spindle_turns_ = modal.spindle != SpindleDirection::Stopped;
        coolant_flows_ = modal.mist || modal.flood;
    }
    /// `interpreter` is at the action's block; it provides the places of words for errors.
    void take(const Action& action, int line, const Interpreter& interpreter);
    /// Continues behind a probing move. Returns the touch as the interpreter needs it. Axes that it did not move stay
    /// at their exact places.
    Touch go_on_behind(const ProbeTouch& touch);
    /// The errors of the actions since the last call.
    std::vector<GcodeError> take_errors() { return std::exchange(errors_, {}); }

    /// The program has too many blocks. No more are kept.
    bool is_full() const { return is_full_; }

    ProgramHead head() const { return program_.head(); }
    BuiltBlocks& blocks() { return blocks_; }
    /// The notes since the last call.
    std::vector<GcodeNote> take_notes() { return std::exchange(notes_, {}); }

    /// The last message since the last pause.
    const std::string& message() const { return message_; }
    /// The spindle was switched on or got another speed, and no move with a feed has come since.
    bool awaits_speed() const { return awaits_speed_; }

    GcodeReading reading() && {
        program_.blocks = blocks_.take();
        return {std::move(program_), std::move(notes_), {}};
    }

private:
    void move(const Point& target, double feed, bool rapid);
    void arc(const Arc& arc);
    void arc_as_chords(const Arc& arc);
    void spline(const Spline& spline);
    std::optional<ArcShape> shape_of(const Arc& arc) const;
    ProgramMove move_to(const std::vector<double>& to, double feed, std::optional<ArcShape> arc) const;
    double within_travel(std::size_t axis, double mm);
    double feed_along_path(const ProgramMove& move) const;
    void probe(const Probing& probing);
    const InputConfig* probe_numbered(std::optional<int> number);
    void event(const Event& event);
    void end();
    void change_tool(int tool);
    void pause(PauseReason reason, int tool = 0);
    void wait_for_input(const Event& event);
    void pulses(const Event& event);
    void pulses_at(const GcodePulses& output, const Event& event);
    void append_pulses(const Event& event, double first_mm, double spacing_mm);
    void remark(const std::string& text);
    /// Reports the word as an error if its rule refuses it.
    bool is_refused(WordRule rule, const char* what, const char* key);
    /// Appends the event of a word for a device, unless the word is refused.
    void device_event(WordRule rule, const char* what, const char* key, const ProgramEvent& event);
    void note(const std::string& kind, const std::string& text);
    void note_message(const std::string& text);
    void await_speed(const decltype(lockstep::Block::action)& next);
    void append(decltype(lockstep::Block::action) action);
    void fail(std::size_t axis, const std::string& message);
    void fail(const std::string& message);

    const GcodeSetup& setup_;
    std::vector<std::optional<std::size_t>> places_;
    Program program_;  // without its blocks
    BuiltBlocks blocks_;
    std::vector<GcodeNote> notes_;
    std::set<std::string> noted_;
    std::vector<double> position_;
    std::vector<double> next_position_;  // move, arc: keeps its memory
    std::vector<double> probed_from_;    // where the last probing move began
    Point at_{};
    std::vector<GcodeError> errors_;
    bool is_full_ = false;
    int line_ = 0;
    double travel_tolerance_mm_ = kTravelTolerance_mm;  // arcs may be as far outside as they deviate from their spline
    std::set<std::size_t> outside_;      // axes named in this line's errors; their number: the height map
    std::uint32_t events_together_ = 0;  // events since the last block of another kind
    std::string message_;                // the last one since the last pause
    std::string remark_;                 // the last comment, on line remark_line_
    int remark_line_ = 0;
    std::map<int, std::string> tool_names_;  // by comments
    bool spindle_turns_ = false;
    bool coolant_flows_ = false;
    bool awaits_speed_ = false;
    bool is_behind_probe_ = false;  // the machine rests before the next block
    const Interpreter* interpreter_ = nullptr;
};

}  // namespace lockstep::gcode
