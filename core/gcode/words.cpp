#include "core/gcode/words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/number_text.hpp"

namespace lockstep {
namespace {

/// A character that means something, and where it stood. A comment is kept as one '(': it ends a number.
struct Character {
    char value = 0;
    int column = 0;
};

constexpr bool is_letter(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool is_of_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-'; }
constexpr bool is_printable(char c) { return c >= ' ' && c <= '~'; }
/// Of ASCII; a tab is a space.
constexpr bool is_control(char c) { return (c >= 0 && c < ' ' && c != '\t') || c == 0x7F; }
constexpr char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

std::string shown(char c) {
    if (is_printable(c)) { return std::string("'") + c + "'"; }
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    return std::string("the byte 0x") + kDigits[byte / 16] + kDigits[byte % 16];
}

class LineSplitter {
public:
    LineSplitter(std::string_view line, int number) : line_(line), number_(number) {}

    std::expected<GcodeLine, GcodeError> split() {
        if (line_.size() > kMaxGcodeLineLength) {
            return error(static_cast<int>(kMaxGcodeLineLength) + 1,
                         "the line has " + std::to_string(line_.size()) + " characters, more than " +
                             std::to_string(kMaxGcodeLineLength) + "; split it");
        }
        if (auto fault = find_control_byte()) { return std::unexpected(*fault); }
        if (auto fault = drop_spaces_and_comments()) { return std::unexpected(*fault); }
        return take_line();
    }

private:
    std::unexpected<GcodeError> error(int column, std::string message) const {
        return std::unexpected(GcodeError{number_, column, std::move(message)});
    }

    /// Also in a comment: a file with them is damaged, or no text.
    std::optional<GcodeError> find_control_byte() const {
        const auto found = std::ranges::find_if(line_, is_control);
        if (found == line_.end()) { return std::nullopt; }
        return GcodeError{number_, static_cast<int>(found - line_.begin()) + 1,
                          shown(*found) + " is a control byte, not text; take it out"};
    }

    std::optional<GcodeError> drop_spaces_and_comments() {
        for (std::size_t i = 0; i < line_.size(); ++i) {
            const char c = line_[i];
            const int column = static_cast<int>(i) + 1;
            if (c == ' ' || c == '\t') { continue; }
            if (c == ';') { break; }
            if (c == '(') {
                const std::size_t end = line_.find_first_of("()", i + 1);
                if (end == std::string_view::npos) {
                    return GcodeError{number_, column, "the comment is not closed; write ) before the line's end"};
                }
                if (line_[end] == '(') {
                    return GcodeError{number_, static_cast<int>(end) + 1,
                                      "a comment inside a comment; take one ( away"};
                }
                i = end;
            } else if (!is_printable(c)) {
                return GcodeError{number_, column,
                                  shown(c) + " is not G-code; outside comments a program is printable ASCII"};
            }
            characters_.push_back({capital(c), column});
        }
        return std::nullopt;
    }

    bool done() const { return at_ == characters_.size(); }
    bool take(char c) {
        if (done() || characters_[at_].value != c) { return false; }
        ++at_;
        return true;
    }
    void skip_comments() {
        while (take('(')) {}
    }

    std::expected<GcodeLine, GcodeError> take_line() {
        GcodeLine result;
        skip_comments();
        result.tape_mark = take('%');
        result.deletable = take('/');
        for (skip_comments(); !done(); skip_comments()) {
            if (result.tape_mark) { return error(characters_[at_].column, "a % stands alone on its line"); }
            auto word = take_word();
            if (!word) { return std::unexpected(word.error()); }
            result.words.push_back(*std::move(word));
        }
        return result;
    }

    std::expected<GcodeWord, GcodeError> take_word() {
        const Character letter = characters_[at_++];
        if (!is_letter(letter.value)) {
            return error(letter.column, shown(letter.value) + " where a word's letter is expected");
        }
        std::string digits;
        while (!done() && is_of_number(characters_[at_].value)) { digits += characters_[at_++].value; }
        const auto value = to_number(digits);
        if (!value) {
            return error(letter.column, digits.empty() ? std::string("the word ") + letter.value + " has no number"
                                                       : "'" + digits + "' after " + letter.value +
                                                             " is not a number; write it like -12.5");
        }
        if (std::abs(*value) > kMaxGcodeNumber) {
            return error(letter.column, letter.value + digits + " is out of range; numbers go to " +
                                            number_text(kMaxGcodeNumber) + " either way");
        }
        return GcodeWord{letter.value, *value, letter.column, letter.value + digits};
    }

    static std::optional<double> to_number(std::string_view digits) {
        if (digits.starts_with('+')) {
            digits.remove_prefix(1);
            if (digits.starts_with('-')) { return std::nullopt; }
        }
        double value = 0;
        const char* end = digits.data() + digits.size();
        const auto result = std::from_chars(digits.data(), end, value, std::chars_format::fixed);
        if (result.ec == std::errc::invalid_argument || result.ptr != end) { return std::nullopt; }
        return value;
    }

    std::string_view line_;
    int number_;
    std::vector<Character> characters_;
    std::size_t at_ = 0;
};

}  // namespace

std::expected<GcodeLine, GcodeError> split_gcode_line(std::string_view line, int number) {
    return LineSplitter(line, number).split();
}

}  // namespace lockstep
