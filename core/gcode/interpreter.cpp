#include "core/gcode/interpreter.hpp"

#include <utility>

#include "core/gcode/run/compensation.hpp"
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {

Interpreter::Interpreter(Setup setup, State state, Sink sink)
    : Interpreter(std::move(setup), Memory{.state = std::move(state)}, std::move(sink)) {
    begin(state_);
}

Interpreter::Interpreter(Setup setup, Memory memory, Sink sink)
    : setup_(std::move(setup)),
      state_(std::move(memory.state)),
      sink_([this, take = std::move(sink)](const Action& action, int line) {
          idle_lines_ = 0;
          repeated_lines_ += levels_.empty() ? 0 : 1;
          take(action, line);
      }),
      parameters_(state_.parameters, *this, std::move(memory.local)),
      kept_(std::move(memory.kept)),
      returned_(memory.returned),
      has_returned_(memory.has_returned) {}

Memory Interpreter::memory() const {
    return {.state = state_,
            .local = parameters_.local(),
            .kept = kept_,
            .returned = returned_,
            .has_returned = has_returned_};
}

std::unexpected<GcodeError> Interpreter::error(std::size_t place, std::string message) const {
    return std::unexpected(line_.error(place, std::move(message)));
}

Result Interpreter::take(std::string_view text, int number) {
    if (ended_) { return {}; }
    program_line_ = number;
    block_.clear();
    if (auto wrong = line_.read(text, number)) { return std::unexpected(*std::move(wrong)); }
    if (line_.text().empty()) { return {}; }
    return take_line(text);
}

Result Interpreter::take_line(std::string_view text) {
    if (line_.at(0) == '%') { return take_percent(); }
    Reader reader(line_, parameters_);
    const bool is_done = skip_head(reader);
    if (reader.error()) { return std::unexpected(*reader.error()); }
    if (reader.peek() == 'O' && is_done) {
        begun_ = true;
        const OWord word = read_o_word(reader);
        if (reader.error()) { return std::unexpected(*reader.error()); }
        if (recorder_.active()) { return keep(word, text); }
        return do_o_word(reader, word);
    }
    if (recorder_.active()) { return keep({}, text); }
    return is_done ? do_plain(reader) : Result{};
}

/// A % before the program opens it, the next one ends it.
Result Interpreter::take_percent() {
    for (std::size_t at = 1; at < line_.text().size(); at = line_.end_of_comment(at)) {
        if (line_.at(at) != '(') { return error(at, "a % must be alone on its line"); }
    }
    if (begun_) { return finish(); }
    begun_ = true;
    return {};
}

/// Skips comments before a /, block delete and line number. Returns false if the line must not be run.
bool Interpreter::skip_head(const Line& line, Reader& reader) const {
    std::size_t place = 0;
    while (line.at(place) == '(') { place = line.end_of_comment(place); }
    if (line.at(place) == '/') { reader.go_to(place); }
    const bool is_deletable = reader.take('/');
    const std::size_t begin = reader.place();
    if (reader.take('N')) {
        if (!is_of_number(reader.peek())) {
            reader.fail(begin, word_text(line, begin) + " is not a line number; a line number must be 0 or above");
            return true;
        }
        (void)reader.word_value(begin);
    }
    return !(is_deletable && setup_.skip_deletable);
}

Context Interpreter::context() {
    KeptModes* kept = &kept_;
    for (Level& level : levels_) { kept = level.is_call ? &level.kept : kept; }
    return {setup_, state_, parameters_, sink_, line_, block_, *kept};
}

Result Interpreter::do_plain(Reader& reader) {
    block_.clear();
    if (auto wrong = read_block(reader, line_, setup_.axes, block_)) { return std::unexpected(*std::move(wrong)); }
    if (!block_.assignments.empty()) {
        if (auto assigned = assign(); !assigned) { return assigned; }
    }
    Context here = context();
    auto done = run_block(here);
    if (done && state_.cutter.waiting.size() > kMostWaiting) {
        done =
            error(0, "more than " + std::to_string(kMostWaiting) +
                         " blocks in sequence do not move in the plane of cutter compensation; write G40 before them");
        state_.cutter.waiting.clear();
        leave_compensation(here);
    }
    const bool is_comment = line_.at(0) == '(' && line_.end_of_comment(0) == line_.text().size();
    begun_ = begun_ || !is_comment;
    ended_ = ended_ || here.ended;
    awaits_touch_ = here.awaits_touch;
    return done;
}

Result Interpreter::assign() {
    for (const Assignment& assignment : block_.assignments) {
        const bool is_read_only = std::visit([&](const auto& parameter) { return parameters_.is_read_only(parameter); },
                                             assignment.parameter);
        if (is_read_only) { return error(line_.text().find('#'), "this parameter can only be read"); }
        std::visit([&](const auto& parameter) { parameters_.set(parameter, assignment.value); }, assignment.parameter);
    }
    return {};
}

Result Interpreter::keep(const OWord& word, std::string_view text) {
    if (word.keyword == Keyword::Sub && word.label && called_early_.contains(*word.label)) {
        return error(word.place,
                     "the subroutine " + *word.label +
                         " is defined after its call, in lines that the program runs; define it before the call, "
                         "or after M2");
    }
    if (++kept_lines_ > setup_.limits.kept_lines) {
        recorder_.clear();
        return error(0, "loops and subroutines have more than " + std::to_string(setup_.limits.kept_lines) +
                            " lines; divide the program");
    }
    if (auto wrong = recorder_.take(line_, word, text)) { return std::unexpected(*std::move(wrong)); }
    return recorder_.active() ? Result{} : close_body();
}

Result Interpreter::do_o_word(Reader& reader, const OWord& word) {
    if (word.keyword == Keyword::Call) {
        if (auto called = call(reader, word); !called) { return called; }
        return run_on();
    }
    if (word.keyword == Keyword::Number) { return rest_is_empty(reader); }
    return keep(word, line_.raw());
}

/// Stores a subroutine for its call. Runs any other body at once.
Result Interpreter::close_body() {
    const bool is_subroutine = recorder_.is_subroutine();
    Body body = recorder_.take_body();
    if (is_subroutine) {
        subroutines_.insert_or_assign(body.label, std::move(body));
        return {};
    }
    running_ = std::move(body);
    levels_.push_back({.body = &*running_, .kept = {}, .repeats = {}});
    return run_on();
}

Result Interpreter::go_on_behind(const Touch& touch) {
    awaits_touch_ = false;
    note_touch(state_, touch);
    return run_on();
}

Result Interpreter::finish() {
    ended_ = true;
    if (auto wrong = recorder_.unclosed()) {
        recorder_.clear();
        return std::unexpected(*std::move(wrong));
    }
    Context here = context();
    end_compensation(here);
    return {};
}

}  // namespace lockstep::gcode
