// The line of an O-word: a keyword with a label, such as o100 if [..] or o<name> call [..].
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "core/gcode/text/reader.hpp"

namespace lockstep::gcode {

enum class Keyword : std::uint8_t {
    None,
    Number,  // the label alone: a program's number, which does nothing
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
};

std::string_view name_of(Keyword keyword);
/// Whether it begins a branch or a loop. A while that ends a do loop has this keyword too.
constexpr bool opens(Keyword keyword) {
    return keyword == Keyword::If || keyword == Keyword::While || keyword == Keyword::Do || keyword == Keyword::Repeat;
}
/// The keyword that ends what `keyword` opens.
Keyword end_of(Keyword keyword);

struct OWord {
    Keyword keyword = Keyword::None;
    std::string written;    // the label as digits, as <name>, or as the expression that computes it
    std::size_t place = 0;  // of the O, in the line
    /// Digits, or a name in small letters. An error if the label's parameters have no value yet: a body is stored
    /// before it runs.
    std::expected<std::string, GcodeError> label;
};

/// The O and the label as written.
inline std::string shown_label(const OWord& word) { return "O" + word.written; }

/// "O100 WHILE".
std::string shown_word(const OWord& word, Keyword keyword);
std::string shown_word(const OWord& word);
/// "o<name> call", of a label that is known.
inline std::string shown_call(const OWord& word) { return "o<" + *word.label + "> call"; }

/// Whether two O-words of a body have the same label, as far as that is known before the body runs.
bool same_label(const OWord& a, const OWord& b);

/// Reads from the O to the end of the keyword. Arguments or a condition behind it are not read.
OWord read_o_word(Reader& reader);
/// Reads the arguments behind the keyword of a call, each in [ ].
Arguments read_arguments(Reader& reader);
/// Returns the reader's error, or one if anything but comments follows.
Result nothing_follows(Reader& reader);
/// The O-word of a line; nullopt if the line has none, or one that cannot be read. `raw` is the line without its end.
std::optional<OWord> find_o_word(std::string_view raw);

}  // namespace lockstep::gcode
