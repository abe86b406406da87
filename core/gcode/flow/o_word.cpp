#include "core/gcode/flow/o_word.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/gcode/text/functions.hpp"
#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

/// If one keyword is the beginning of another, the longer one comes first.
constexpr std::array kKeywords{
    Named{"SUB", Keyword::Sub},
    Named{"ENDSUB", Keyword::EndSub},
    Named{"CALL", Keyword::Call},
    Named{"RETURN", Keyword::Return},
    Named{"IF", Keyword::If},
    Named{"ELSEIF", Keyword::ElseIf},
    Named{"ELSE", Keyword::Else},
    Named{"ENDIF", Keyword::EndIf},
    Named{"WHILE", Keyword::While},
    Named{"ENDWHILE", Keyword::EndWhile},
    Named{"DO", Keyword::Do},
    Named{"REPEAT", Keyword::Repeat},
    Named{"ENDREPEAT", Keyword::EndRepeat},
    Named{"BREAK", Keyword::Break},
    Named{"CONTINUE", Keyword::Continue},
};

std::string read_label(Reader& reader) {
    if (reader.peek() == '<') { return reader.name(); }
    const std::size_t begin = reader.place();
    const double number = reader.value();
    if (reader.error()) { return {}; }
    const double whole = std::round(number);
    if (std::abs(number - whole) > 1e-4 || whole < 0 || whole > 1e9) {
        reader.fail(begin, "O" + number_text(number) + " is not a label; write a whole number from 0, or <name>");
        return {};
    }
    return std::to_string(static_cast<long long>(whole));
}

}  // namespace

std::string_view name_of(Keyword keyword) {
    for (const auto& entry : kKeywords) {
        if (entry.meaning == keyword) { return entry.name; }
    }
    return "";
}

bool opens(Keyword keyword) {
    return keyword == Keyword::Sub || keyword == Keyword::If || keyword == Keyword::While || keyword == Keyword::Do ||
           keyword == Keyword::Repeat;
}

Keyword end_of(Keyword keyword) {
    switch (keyword) {
        case Keyword::Sub: return Keyword::EndSub;
        case Keyword::If: return Keyword::EndIf;
        case Keyword::While: return Keyword::EndWhile;
        case Keyword::Do: return Keyword::While;
        default: return Keyword::EndRepeat;
    }
}

std::string shown_label(const std::string& label) {
    const bool is_number = std::ranges::all_of(label, [](char c) { return c >= '0' && c <= '9'; });
    return is_number ? "O" + label : "O<" + label + ">";
}

std::string shown_word(Keyword keyword, const std::string& label) {
    return shown_label(label) + " " + std::string(name_of(keyword));
}

std::optional<OWord> find_o_word(std::string_view raw) {
    Line line;
    if (raw.find_first_of("oO") == std::string_view::npos || line.read(raw, 1)) { return std::nullopt; }
    const struct : SystemValues {
        std::optional<double> numbered(int) const override { return std::nullopt; }
        std::optional<double> named(std::string_view) const override { return std::nullopt; }
    } none;
    ParameterValues values;
    const Parameters parameters(values, none);
    Reader reader(line, parameters);
    while (reader.peek() == '(') { reader.skip_comment(); }
    if (reader.take('N')) { (void)reader.value(); }
    if (reader.peek() != 'O') { return std::nullopt; }
    OWord word = read_o_word(reader);
    return reader.error() ? std::nullopt : std::optional(std::move(word));
}

OWord read_o_word(Reader& reader) {
    OWord word{.label = {}, .place = reader.place()};
    reader.next();
    word.label = read_label(reader);
    if (reader.error()) { return word; }
    for (const auto& entry : kKeywords) {
        if (reader.take(entry.name)) {
            word.keyword = entry.meaning;
            return word;
        }
    }
    reader.fail(reader.place(),
                "the O-word has no keyword; write sub, call, return, if, while, do, repeat, break, "
                "continue, or the end of one of them");
    return word;
}

}  // namespace lockstep::gcode
