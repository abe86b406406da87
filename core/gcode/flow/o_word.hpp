// The line of an O-word: a keyword with a label, such as o100 if [..] or o<name> call [..].
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/gcode/text/reader.hpp"

namespace lockstep::gcode {

enum class Keyword : std::uint8_t {
    None,
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
/// Whether the keyword begins a subroutine, a loop or branches.
bool opens(Keyword keyword);
/// The keyword that ends what `keyword` opens.
Keyword end_of(Keyword keyword);
/// "O100", or "O<name>".
std::string shown_label(const std::string& label);
/// "O100 WHILE".
std::string shown_word(Keyword keyword, const std::string& label);

struct OWord {
    Keyword keyword = Keyword::None;
    std::string label;      // of digits, or a name in small letters
    std::size_t place = 0;  // of the O, in the line
};

/// Reads from the O to the end of the keyword. Arguments or a condition behind it are not read.
OWord read_o_word(Reader& reader);
/// The O-word of a line; nullopt if the line has none, or one that cannot be read. `raw` is the line without its end.
std::optional<OWord> find_o_word(std::string_view raw);

}  // namespace lockstep::gcode
