#include "core/gcode/flow/body.hpp"

#include <algorithm>

namespace lockstep::gcode {
namespace {

constexpr const char* kOfSubroutines = "<sub>";  // scope of the labels of subroutines; no subroutine has this name

bool is_loop(Keyword keyword) {
    return keyword == Keyword::While || keyword == Keyword::Do || keyword == Keyword::Repeat;
}

}  // namespace

void Recorder::clear() {
    body_ = {};
    open_.clear();
}

std::string Recorder::not_open(const OWord& word) const {
    const std::string text = shown_word(word.keyword, word.label) + " has no beginning here; ";
    if (open_.empty()) { return text + "no O-word is open"; }
    const Open& last = open_.back();
    return text + shown_word(last.keyword, last.label) + " of line " + std::to_string(body_.lines[last.line].number) +
           " is open and ends with " + shown_word(end_of(last.keyword), last.label);
}

/// A label opens one thing only, except do loops, which may be opened again. Subroutines have separate labels.
std::optional<std::string> Recorder::open(const OWord& word) {
    const bool in_subroutine = !open_.empty() && open_.front().keyword == Keyword::Sub;
    if (word.keyword == Keyword::Sub && !open_.empty()) {
        return shown_word(word.keyword, word.label) + " is inside " +
               shown_word(open_.back().keyword, open_.back().label) + "; define the subroutine outside of it";
    }
    const std::string scope = word.keyword == Keyword::Sub ? kOfSubroutines : in_subroutine ? open_.front().label : "";
    const auto [before, is_new] = labels_.try_emplace({scope, word.label}, word.keyword);
    const bool is_do_again = word.keyword == Keyword::Do && before->second == Keyword::Do;
    if (!is_new && !is_do_again) {
        return shown_label(word.label) + " is the label of an earlier O-word; use another label";
    }
    if (open_.empty()) { body_.label = word.label; }
    open_.push_back(
        {.keyword = word.keyword, .label = word.label, .line = body_.lines.size() - 1, .branches = {}, .exits = {}});
    if (word.keyword == Keyword::If) { open_.back().branches.push_back(body_.lines.size() - 1); }
    return std::nullopt;
}

std::optional<std::string> Recorder::branch(const OWord& word) {
    if (open_.empty() || open_.back().keyword != Keyword::If || open_.back().label != word.label) {
        return not_open(word);
    }
    Open& open = open_.back();
    if (open.has_else) { return shown_word(word.keyword, word.label) + " is after the else; remove one of them"; }
    const std::size_t here = body_.lines.size() - 1;
    for (const std::size_t line : open.branches) { body_.lines[line].branch = here; }
    open.branches.clear();
    if (word.keyword == Keyword::ElseIf) { open.branches.push_back(here); }
    open.has_else = word.keyword == Keyword::Else;
    open.exits.push_back(here);
    return std::nullopt;
}

std::optional<std::string> Recorder::close(const OWord& word) {
    if (open_.empty() || open_.back().label != word.label || end_of(open_.back().keyword) != word.keyword) {
        return not_open(word);
    }
    const Open& open = open_.back();
    const std::size_t here = body_.lines.size() - 1;
    for (const std::size_t line : open.branches) { body_.lines[line].branch = here; }
    for (const std::size_t line : open.exits) { body_.lines[line].end = here; }
    body_.lines[open.line].end = here;
    body_.lines[here].begin = open.line;
    body_.lines[here].keyword = open.keyword == Keyword::Do ? Keyword::EndWhile : word.keyword;
    open_.pop_back();
    return std::nullopt;
}

/// Break and continue name an enclosing loop. Return belongs to the subroutine.
std::optional<std::string> Recorder::leave(const OWord& word) {
    const bool is_return = word.keyword == Keyword::Return;
    const auto found = std::ranges::find_if(open_, [&](const Open& open) {
        return is_return ? open.keyword == Keyword::Sub : is_loop(open.keyword) && open.label == word.label;
    });
    if (found == open_.end()) {
        return shown_word(word.keyword, word.label) + " is not inside " +
               (is_return ? "a subroutine" : "a loop of that label") + "; remove it";
    }
    const std::size_t here = body_.lines.size() - 1;
    body_.lines[here].begin = found->line;
    found->exits.push_back(here);
    return std::nullopt;
}

std::optional<std::string> Recorder::place(const OWord& word) {
    const bool ends_do = word.keyword == Keyword::While && !open_.empty() && open_.back().keyword == Keyword::Do &&
                         open_.back().label == word.label;
    if (ends_do) { return close(word); }
    if (opens(word.keyword)) { return open(word); }
    switch (word.keyword) {
        case Keyword::ElseIf:
        case Keyword::Else: return branch(word);
        case Keyword::Break:
        case Keyword::Continue:
        case Keyword::Return: return leave(word);
        case Keyword::None:
        case Keyword::Call: return std::nullopt;
        default: return close(word);
    }
}

std::optional<GcodeError> Recorder::take(const Line& line, const OWord& word, std::string_view text) {
    body_.lines.push_back({.number = line.number(), .text = std::string(text), .keyword = word.keyword});
    if (const auto wrong = place(word)) {
        GcodeError error = line.error(word.place, *wrong);
        clear();
        return error;
    }
    return std::nullopt;
}

std::optional<std::string> Recorder::open_word() const {
    if (open_.empty()) { return std::nullopt; }
    return shown_word(open_.front().keyword, open_.front().label);
}

std::optional<GcodeError> Recorder::unclosed() const {
    if (open_.empty()) { return std::nullopt; }
    const Open& last = open_.back();
    return GcodeError{
        body_.lines[last.line].number, 1,
        shown_word(last.keyword, last.label) + " is not closed; write " + shown_word(end_of(last.keyword), last.label)};
}

}  // namespace lockstep::gcode
