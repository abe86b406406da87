#include "core/gcode/interpreter.hpp"

#include <utility>

#include "core/gcode/run/compensation.hpp"
#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

/// A % before the program opens it, the next one ends it. Only comments may be on its line.
Result percent_is_alone(const Line& line) {
    for (std::size_t at = 1; at < line.text().size(); at = line.end_of_comment(at)) {
        if (line.at(at) != '(') { return std::unexpected(line.error(at, "a % must be alone on its line")); }
    }
    return {};
}

Result assign(const std::vector<Assignment>& assignments, const Line& line, Parameters& parameters) {
    for (const Assignment& assignment : assignments) {
        const bool is_read_only =
            std::visit([&](const auto& parameter) { return parameters.is_read_only(parameter); }, assignment.parameter);
        if (is_read_only) {
            return std::unexpected(line.error(line.text().find('#'), "this parameter can only be read"));
        }
        std::visit([&](const auto& parameter) { parameters.set(parameter, assignment.value); }, assignment.parameter);
    }
    return {};
}

}  // namespace

Interpreter::Interpreter(Setup setup, State state, Sink sink)
    : Interpreter(std::move(setup), Memory{.state = std::move(state)}, std::move(sink)) {
    begin(state_);
}

Interpreter::Interpreter(Setup setup, Memory memory, Sink sink)
    : setup_(std::move(setup)),
      state_(std::move(memory.state)),
      sink_([this, take = std::move(sink)](const Action& action, int line) {
          count_.add_action(is_within_body());
          take(action, line);
      }),
      system_(state_, stack_, line_),
      parameters_(state_.parameters, system_, std::move(memory.local)),
      bodies_(setup_, parameters_),
      stack_(parameters_, std::move(memory.kept), memory.returned),
      labels_(setup_.limits.kept_lines),
      count_(setup_.limits) {}

Memory Interpreter::memory() const {
    return {.state = state_, .local = parameters_.local(), .kept = stack_.kept(), .returned = stack_.returned()};
}

Result Interpreter::take(std::string_view text, int number) {
    if (ended_) { return {}; }
    program_line_ = number;
    block_.clear();
    if (auto wrong = line_.read(text, number)) { return std::unexpected(*std::move(wrong)); }
    if (line_.text().empty()) { return {}; }
    if (line_.at(0) != '%') { return take_line(text); }
    if (auto alone = percent_is_alone(line_); !alone) { return alone; }
    return std::exchange(begun_, true) ? finish() : Result{};
}

Result Interpreter::take_line(std::string_view text) {
    Reader reader(line_, parameters_);
    const bool is_run = skip_head(line_, reader, setup_.skip_deletable);
    if (reader.error()) { return std::unexpected(*reader.error()); }
    if (reader.peek() == 'O' && is_run) { return take_o_word(reader, text); }
    if (bodies_.is_recording()) { return store({}, text); }
    return is_run ? run_plain(reader) : Result{};
}

Result Interpreter::take_o_word(Reader& reader, std::string_view text) {
    begun_ = true;
    const OWord word = read_o_word(reader);
    if (reader.error()) { return std::unexpected(*reader.error()); }
    if (bodies_.is_recording()) { return store(word, text); }
    if (word.keyword == Keyword::Number) { return nothing_follows(reader); }
    if (word.keyword != Keyword::Call) { return store(word, text); }
    if (auto called = call(reader, word); !called) { return called; }
    return run_bodies();
}

Result Interpreter::store(const OWord& word, std::string_view text) {
    const auto loop = bodies_.take(line_, word, text);
    if (!loop) { return std::unexpected(loop.error()); }
    if (*loop == nullptr) { return {}; }
    stack_.run(**loop);
    return run_bodies();
}

Result Interpreter::call(Reader& reader, const OWord& word) {
    if (!word.label) { return std::unexpected(word.label.error()); }
    const Arguments arguments = read_arguments(reader);
    if (auto empty = nothing_follows(reader); !empty) { return empty; }
    const auto subroutine = bodies_.find(word, line_, program_line_);
    if (!subroutine) { return std::unexpected(subroutine.error()); }
    if (stack_.calls() >= setup_.limits.call_depth) {
        return std::unexpected(line_.error(word.place, shown_call(word) + " is nested deeper than " +
                                                           std::to_string(setup_.limits.call_depth) +
                                                           " calls; check that it ends before it calls itself again"));
    }
    stack_.call(**subroutine, arguments);
    return {};
}

/// Runs stored lines to their end, or to the next probing move.
Result Interpreter::run_bodies() {
    Result done;
    while (done && is_within_body() && !ended_ && !awaits_touch_) {
        BodyRun& run = stack_.innermost();
        if (run.is_done()) {
            if (const auto modes = stack_.modes_behind()) {
                Context here = context();
                restore(here, *modes);
            }
            stack_.end();
            continue;
        }
        const Body& body = run.body();
        done = run_stored(run.take_line());
        if (!done && !body.file.empty()) { done.error().message += " (in " + body.file + ")"; }
    }
    if (!done || !awaits_touch_) { stack_.end_all(); }
    if (stack_.is_empty()) { bodies_.remove_loop(); }
    return done;
}

Result Interpreter::run_stored(const KeptLine& kept) {
    if (auto wrong = line_.read(kept.text, kept.number)) { return std::unexpected(*std::move(wrong)); }
    if (auto wrong = count_.add_line()) { return std::unexpected(line_.error(0, *std::move(wrong))); }
    Reader reader(line_, parameters_);
    if (!skip_head(line_, reader, setup_.skip_deletable) || reader.done()) { return {}; }
    if (kept.keyword == Keyword::None) { return run_plain(reader); }
    const OWord word = read_o_word(reader);
    if (reader.error()) { return std::unexpected(*reader.error()); }
    if (kept.keyword == Keyword::Call) { return call(reader, word); }
    if (kept.keyword == Keyword::Return || kept.keyword == Keyword::EndSub) { return stack_.leave(reader); }
    if (opens(kept.keyword)) {
        if (auto wrong = labels_.open(stack_.subroutine(), word, line_)) { return std::unexpected(*std::move(wrong)); }
    }
    return stack_.innermost().follow(reader);
}

Context Interpreter::context() { return {setup_, state_, parameters_, sink_, line_, block_, stack_.kept()}; }

Result Interpreter::run_plain(Reader& reader) {
    block_.clear();
    if (auto wrong = read_block(reader, line_, setup_.axes, block_)) { return std::unexpected(*std::move(wrong)); }
    if (auto assigned = assign(block_.assignments, line_, parameters_); !assigned) { return assigned; }
    Context here = context();
    auto done = run_block(here);
    if (done && state_.cutter.waiting.size() > kMostWaiting) {
        done = std::unexpected(line_.error(
            0, "more than " + std::to_string(kMostWaiting) +
                   " blocks in sequence do not move in the plane of cutter compensation; write G40 before them"));
        state_.cutter.waiting.clear();
        leave_compensation(here);
    }
    const bool is_comment = line_.at(0) == '(' && line_.end_of_comment(0) == line_.text().size();
    begun_ = begun_ || !is_comment;
    ended_ = ended_ || here.ended;
    awaits_touch_ = here.awaits_touch;
    return done;
}

Result Interpreter::go_on_behind(const Touch& touch) {
    awaits_touch_ = false;
    note_touch(state_, touch);
    return run_bodies();
}

Result Interpreter::finish() {
    ended_ = true;
    if (auto closed = bodies_.finish(); !closed) { return closed; }
    Context here = context();
    end_compensation(here);
    return {};
}

}  // namespace lockstep::gcode
