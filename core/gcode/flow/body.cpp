#include "core/gcode/flow/body.hpp"

#include <algorithm>

namespace lockstep::gcode {
namespace {

bool is_loop(Keyword keyword) {
    return keyword == Keyword::While || keyword == Keyword::Do || keyword == Keyword::Repeat;
}

}  // namespace

void Recorder::clear() {
    body_ = {};
    open_.clear();
}

std::string Recorder::not_open(const OWord& word) const {
    const std::string text = shown_word(word) + " has no beginning here; ";
    if (open_.empty()) { return text + "no O-word is open"; }
    const Open& last = open_.back();
    return text + shown_word(last.word) + " of line " + std::to_string(body_.lines[last.line].number) +
           " is open and ends with " + shown_word(last.word, end_of(last.word.keyword));
}

std::optional<std::string> Recorder::open(const OWord& word) {
    open_.push_back({.word = word, .line = body_.lines.size() - 1, .branches = {}, .exits = {}});
    if (word.keyword == Keyword::If) { open_.back().branches.push_back(body_.lines.size() - 1); }
    return std::nullopt;
}

std::optional<std::string> Recorder::open_subroutine(const OWord& word) {
    if (!open_.empty()) {
        return shown_word(word) + " is inside " + shown_word(open_.back().word) +
               "; define the subroutine outside of it";
    }
    body_.label = *word.label;
    if (!subroutines_.insert(body_.label).second) {
        return shown_label(word) + " is the label of an earlier subroutine; use another label";
    }
    return open(word);
}

std::optional<std::string> Recorder::branch(const OWord& word) {
    if (open_.empty() || open_.back().word.keyword != Keyword::If || !same_label(open_.back().word, word)) {
        return not_open(word);
    }
    Open& open = open_.back();
    if (open.has_else) { return shown_word(word) + " is after the else; remove one of them"; }
    const std::size_t here = body_.lines.size() - 1;
    for (const std::size_t line : open.branches) { body_.lines[line].branch = here; }
    open.branches.clear();
    if (word.keyword == Keyword::ElseIf) { open.branches.push_back(here); }
    open.has_else = word.keyword == Keyword::Else;
    open.exits.push_back(here);
    return std::nullopt;
}

std::optional<std::string> Recorder::close(const OWord& word) {
    const bool ends =
        !open_.empty() && same_label(open_.back().word, word) && end_of(open_.back().word.keyword) == word.keyword;
    if (!ends) { return not_open(word); }
    const Open& open = open_.back();
    const std::size_t here = body_.lines.size() - 1;
    for (const std::size_t line : open.branches) { body_.lines[line].branch = here; }
    for (const std::size_t line : open.exits) { body_.lines[line].end = here; }
    body_.lines[open.line].end = here;
    body_.lines[here].begin = open.line;
    body_.lines[here].keyword = open.word.keyword == Keyword::Do ? Keyword::EndWhile : word.keyword;
    open_.pop_back();
    return std::nullopt;
}

/// Break and continue name an enclosing loop. Return belongs to the subroutine.
std::optional<std::string> Recorder::leave(const OWord& word) {
    const bool is_return = word.keyword == Keyword::Return;
    const auto found = std::ranges::find_if(open_, [&](const Open& open) {
        return is_return ? open.word.keyword == Keyword::Sub
                         : is_loop(open.word.keyword) && same_label(open.word, word);
    });
    if (found == open_.end()) {
        return shown_word(word) + " is not inside " + (is_return ? "a subroutine" : "a loop of that label") +
               "; remove it";
    }
    const std::size_t here = body_.lines.size() - 1;
    body_.lines[here].begin = found->line;
    found->exits.push_back(here);
    return std::nullopt;
}

std::optional<std::string> Recorder::place(const OWord& word) {
    const bool ends_do = word.keyword == Keyword::While && !open_.empty() && open_.back().word.keyword == Keyword::Do &&
                         same_label(open_.back().word, word);
    if (ends_do) { return close(word); }
    if (word.keyword == Keyword::Sub) { return open_subroutine(word); }
    if (opens(word.keyword)) { return open(word); }
    switch (word.keyword) {
        case Keyword::ElseIf:
        case Keyword::Else: return branch(word);
        case Keyword::Break:
        case Keyword::Continue:
        case Keyword::Return: return leave(word);
        case Keyword::Number:
            if (open_.front().word.keyword != Keyword::Sub) { return std::nullopt; }
            return shown_label(word) +
                   " without a keyword is a program's number, which cannot be inside a subroutine; " +
                   "remove it, or write call behind it";
        case Keyword::None:
        case Keyword::Call: return std::nullopt;
        default: return close(word);
    }
}

std::optional<GcodeError> Recorder::take(const Line& line, const OWord& word, std::string_view text) {
    body_.lines.push_back({.number = line.number(), .text = std::string(text), .keyword = word.keyword});
    std::optional<GcodeError> error;
    if (word.keyword == Keyword::Sub && !word.label) {
        error = word.label.error();
    } else if (const auto wrong = place(word)) {
        error = line.error(word.place, *wrong);
    }
    if (error) { clear(); }
    return error;
}

std::optional<std::string> Recorder::open_word() const {
    if (open_.empty()) { return std::nullopt; }
    return shown_word(open_.front().word);
}

std::optional<GcodeError> Recorder::unclosed() const {
    if (open_.empty()) { return std::nullopt; }
    const Open& last = open_.back();
    return GcodeError{
        body_.lines[last.line].number, 1,
        shown_word(last.word) + " is not closed; write " + shown_word(last.word, end_of(last.word.keyword))};
}

}  // namespace lockstep::gcode
