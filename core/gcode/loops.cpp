// Interpreter: runs stored lines according to their O-words.
#include <cmath>

#include "core/gcode/interpreter.hpp"

namespace lockstep::gcode {

/// Runs the kept lines to their end, or to the next probing move.
Result Interpreter::run_on() {
    auto done = do_frames();
    if (levels_.empty() && running_) {
        kept_lines_ -= running_->lines.size();
        running_.reset();
    }
    return done;
}

Result Interpreter::do_frames() {
    while (!levels_.empty() && !ended_ && !awaits_touch_) {
        Level& level = levels_.back();
        if (level.next >= level.body->lines.size()) {
            end_call();
            continue;
        }
        const Body& body = *level.body;
        const KeptLine& line = body.lines[level.next];
        auto done = do_kept(level, line);
        if (!done) {
            if (!body.file.empty()) { done.error().message += " (in " + body.file + ")"; }
            unwind();
            return done;
        }
    }
    if (!awaits_touch_) { unwind(); }
    return {};
}

Result Interpreter::count_lines() {
    if (++idle_lines_ > setup_.limits.idle_lines) {
        return error(0, "loops and subroutines ran " + std::to_string(setup_.limits.idle_lines) +
                            " lines without a motion or an event; check that each loop ends");
    }
    if (++repeated_lines_ <= setup_.limits.repeated_lines) { return {}; }
    return error(0, "loops and subroutines ran more than " + std::to_string(setup_.limits.repeated_lines) +
                        " lines; check that each loop ends");
}

Result Interpreter::do_kept(Level& level, const KeptLine& kept) {
    if (auto wrong = line_.read(kept.text, kept.number)) { return std::unexpected(*std::move(wrong)); }
    if (auto counted = count_lines(); !counted) { return counted; }
    const std::size_t at = level.next++;
    Reader reader(line_, parameters_);
    if (!skip_head(reader) || reader.done()) { return {}; }
    if (kept.keyword == Keyword::None) { return do_plain(reader); }
    const OWord word = read_o_word(reader);
    if (reader.error()) { return std::unexpected(*reader.error()); }
    if (kept.keyword == Keyword::Call) { return call(reader, word); }
    if (opens(kept.keyword)) {
        if (auto noted = note_opening(word); !noted) { return noted; }
    }
    return do_flow(level, at, reader);
}

/// A label opens one thing only, of those that run. A do loop may open the label of another do loop again.
Result Interpreter::note_opening(const OWord& word) {
    if (!word.label) { return std::unexpected(word.label.error()); }
    std::string subroutine;
    for (const Level& level : levels_) { subroutine = level.is_call ? level.body->label : subroutine; }
    const auto [before, is_new] =
        openings_.try_emplace({std::move(subroutine), *word.label}, Opening{word.keyword, line_.number()});
    const bool is_do_again = word.keyword == Keyword::Do && before->second.keyword == Keyword::Do;
    if (!is_new && before->second.line != line_.number() && !is_do_again) {
        return error(word.place, shown_label(word) + " is the label of an earlier O-word, in line " +
                                     std::to_string(before->second.line) + "; use another label");
    }
    if (openings_.size() <= setup_.limits.kept_lines) { return {}; }
    return error(word.place, shown_label(word) + " is one of more than " + std::to_string(setup_.limits.kept_lines) +
                                 " labels that the program computes; use fewer");
}

Result Interpreter::rest_is_empty(Reader& reader) const {
    while (reader.peek() == '(' && !reader.done()) { reader.skip_comment(); }
    if (!reader.done() && !reader.error()) {
        reader.fail(reader.place(), "nothing may follow on this line; use another line");
    }
    return reader.error() ? Result(std::unexpected(*reader.error())) : Result{};
}

/// Level::next is already the next line.
Result Interpreter::do_flow(Level& level, std::size_t at, Reader& reader) {
    const KeptLine& line = level.body->lines[at];
    switch (line.keyword) {
        case Keyword::If:
        case Keyword::While: {
            const bool holds = reader.expression() != 0;
            if (auto empty = rest_is_empty(reader); !empty) { return empty; }
            if (!holds) { level.next = line.keyword == Keyword::If ? line.branch : line.end + 1; }
            if (line.keyword == Keyword::While || holds) { return {}; }
            return choose_branch(level);
        }
        case Keyword::ElseIf:
        case Keyword::Else: level.next = line.end + 1; return {};
        case Keyword::Repeat: {
            const double count = std::ceil(reader.expression());
            if (auto empty = rest_is_empty(reader); !empty) { return empty; }
            level.repeats[at] = count;
            if (count < 1) { level.next = line.end + 1; }
            return {};
        }
        case Keyword::EndWhile:
        case Keyword::EndRepeat: return go_round(level, at, reader);
        case Keyword::Break: level.next = line.end + 1; return rest_is_empty(reader);
        case Keyword::Continue:
            level.next = level.body->lines[line.begin].keyword == Keyword::While ? line.begin : line.end;
            return rest_is_empty(reader);
        case Keyword::Return:
        case Keyword::EndSub: return leave(level, reader);
        default: return rest_is_empty(reader);
    }
}

/// Called at the elseif, else or endif behind an if that does not hold.
Result Interpreter::choose_branch(Level& level) {
    while (true) {
        const KeptLine& line = level.body->lines[level.next];
        if (line.keyword == Keyword::EndIf) { return {}; }
        if (auto wrong = line_.read(line.text, line.number)) { return std::unexpected(*std::move(wrong)); }
        if (auto counted = count_lines(); !counted) { return counted; }
        ++level.next;
        if (line.keyword == Keyword::Else) { return {}; }
        Reader reader(line_, parameters_);
        (void)skip_head(reader);
        (void)read_o_word(reader);
        const bool holds = reader.expression() != 0;
        if (auto empty = rest_is_empty(reader); !empty) { return empty; }
        if (holds) { return {}; }
        level.next = line.branch;
    }
}

/// Called at the end of a loop.
Result Interpreter::go_round(Level& level, std::size_t at, Reader& reader) {
    const std::size_t begin = level.body->lines[at].begin;
    bool again = true;
    switch (level.body->lines[begin].keyword) {
        case Keyword::While: level.next = begin; return rest_is_empty(reader);
        case Keyword::Do: again = reader.expression() != 0; break;
        default: again = --level.repeats[begin] >= 1; break;
    }
    if (again) { level.next = begin + 1; }
    return rest_is_empty(reader);
}

}  // namespace lockstep::gcode
