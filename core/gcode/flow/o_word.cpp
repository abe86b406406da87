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

std::expected<std::string, GcodeError> read_number(Reader& reader) {
    const std::size_t begin = reader.place();
    const double number = reader.value();
    const double whole = std::round(number);
    if (!reader.error() && (std::abs(number - whole) > 1e-4 || whole < 0 || whole > 1e9)) {
        reader.fail(begin, "O" + number_text(number) + " is not a label; write a whole number from 0, or <name>");
    }
    if (reader.error()) { return std::unexpected(*reader.error()); }
    return std::to_string(static_cast<long long>(whole));
}

void read_label(Reader& reader, OWord& word) {
    if (reader.peek() == '<') {
        word.label = reader.name();
        word.written = "<" + *word.label + ">";
        return;
    }
    Reader evaluation = reader;
    word.label = read_number(evaluation);
    word.written = reader.skip_value();
    if (word.label && is_of_number(word.written.front())) { word.written = *word.label; }
}

Keyword read_keyword(Reader& reader) {
    for (const auto& entry : kKeywords) {
        if (reader.take(entry.name)) { return entry.meaning; }
    }
    return reader.done() || reader.peek() == '(' ? Keyword::Number : Keyword::None;
}

}  // namespace

std::string_view name_of(Keyword keyword) {
    for (const auto& entry : kKeywords) {
        if (entry.meaning == keyword) { return entry.name; }
    }
    return "";
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

std::string shown_word(const OWord& word, Keyword keyword) {
    return shown_label(word) + " " + std::string(name_of(keyword));
}

std::string shown_word(const OWord& word) { return shown_word(word, word.keyword); }

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

bool same_label(const OWord& a, const OWord& b) {
    return a.written == b.written || (a.label && b.label && *a.label == *b.label);
}

OWord read_o_word(Reader& reader) {
    OWord word{.written = {}, .place = reader.place(), .label = {}};
    reader.next();
    read_label(reader, word);
    if (reader.error()) { return word; }
    word.keyword = read_keyword(reader);
    const bool is_unknown = word.keyword == Keyword::None || word.keyword == Keyword::Number;
    if (is_unknown && !word.label) { reader.fail(word.label.error()); }
    if (word.keyword == Keyword::None) {
        reader.fail(reader.place(),
                    "the O-word has no keyword; write sub, call, return, if, while, do, repeat, break, "
                    "continue, or the end of one of them");
    }
    return word;
}

Arguments read_arguments(Reader& reader) {
    Arguments arguments{};
    std::size_t count = 0;
    while (!reader.done() && (reader.peek() == '[' || reader.peek() == '(')) {
        if (reader.peek() == '(') {
            reader.skip_comment();
            continue;
        }
        const std::size_t place = reader.place();
        const double value = reader.expression();
        if (count == kArguments) {
            reader.fail(place, "a call has at most " + std::to_string(kArguments) + " arguments");
        }
        if (!reader.error()) { arguments[count++] = value; }
    }
    return arguments;
}

Result nothing_follows(Reader& reader) {
    while (reader.peek() == '(' && !reader.done()) { reader.skip_comment(); }
    if (!reader.done() && !reader.error()) {
        reader.fail(reader.place(), "nothing may follow on this line; use another line");
    }
    return reader.error() ? Result(std::unexpected(*reader.error())) : Result{};
}

}  // namespace lockstep::gcode
