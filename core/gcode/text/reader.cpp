#include "core/gcode/text/reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

constexpr int kInputResult = 5399;

constexpr char small(char c) { return is_letter(c) ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr int kExactDigits = 15;  // of a whole number that a double holds exactly
constexpr std::array kPowers{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// Reads digits with at most one point, if they are few: the quotient of two exact numbers is the nearest double, as
/// from_chars gives it. Returns the number of characters, or 0 if they are too many or no number.
std::size_t read_short_number(std::string_view text, double& result) {
    std::int64_t digits = 0;
    int count = 0;
    int decimals = -1;  // -1: before the point
    std::size_t at = 0;
    for (; at < text.size() && is_of_number(text[at]); ++at) {
        if (text[at] == '.') {
            if (decimals >= 0) { return 0; }
            decimals = 0;
            continue;
        }
        digits = 10 * digits + (text[at] - '0');
        decimals += decimals >= 0 ? 1 : 0;
        if (++count > kExactDigits) { return 0; }
    }
    if (count == 0) { return 0; }
    result = static_cast<double>(digits) / kPowers[static_cast<std::size_t>(std::max(decimals, 0))];
    return at;
}

bool is_parameter(double number) {
    const double whole = std::round(number);
    return std::abs(number - whole) <= 1e-4 && whole >= 1 && whole <= kMaxParameter;
}

}  // namespace

void Reader::fail(GcodeError error) {
    if (!error_) { error_ = std::move(error); }
    at_ = line_.text().size();
}

bool Reader::take(char c) {
    if (peek() != c || done()) { return false; }
    ++at_;
    return true;
}

bool Reader::take(std::string_view word) {
    if (!line_.text().substr(std::min(at_, line_.text().size())).starts_with(word)) { return false; }
    at_ += word.size();
    return true;
}

double Reader::word_value(std::size_t letter_at) {
    letter_ = letter_at;
    const double result = value();
    letter_.reset();
    return result;
}

double Reader::value() {
    const char c = peek();
    if (is_of_number(c)) { return number(); }
    if (c == '[') { return expression(); }
    if (c == '#') { return parameter(); }
    if (c == '-' || c == '+') {
        ++at_;
        if (++nesting_ > kMaxNesting) { fail(at_, "too many signs; write one"); }
        const double result = value();
        --nesting_;
        return c == '-' ? -result : result;
    }
    const std::size_t begin = at_;
    const auto function = find_function(line_.text().substr(std::min(at_, line_.text().size())));
    if (function && line_.at(begin + function->name.size()) == '[') { return function_value(*function); }
    const std::string found = done() ? "the line ends" : shown(c);
    if (letter_) {
        fail(*letter_, std::string("the word ") + line_.at(*letter_) + " has no number: " + found +
                           " where a number, #, [ or a function is expected");
    } else {
        fail(begin, found + " where a number, #, [ or a function is expected");
    }
    return 0;
}

double Reader::number() {
    const std::string_view text = line_.text();
    const std::size_t begin = at_;
    double result = 0;
    if (const std::size_t read = read_short_number(text.substr(begin), result); read > 0) {
        at_ += read;
        return result;
    }
    const auto [end, error] =
        std::from_chars(text.data() + begin, text.data() + text.size(), result, std::chars_format::fixed);
    at_ = static_cast<std::size_t>(end - text.data());
    if (error == std::errc::invalid_argument || is_of_number(peek())) {
        while (is_of_number(peek())) { ++at_; }
        const std::string_view digits = text.substr(begin, at_ - begin);
        fail(letter_.value_or(begin), "'" + std::string(digits) + "' is not a number; write it like -12.5");
        return 0;
    }
    return result;
}

std::string Reader::skip_value() {
    const std::size_t begin = at_;
    at_ = end_of_value(begin);
    return std::string(line_.text().substr(begin, at_ - begin));
}

std::size_t Reader::end_of_value(std::size_t place) const {
    while (line_.at(place) == '-' || line_.at(place) == '+' || line_.at(place) == '#') { ++place; }
    const std::string_view text = line_.text();
    if (line_.at(place) == '<') { return std::min(text.find('>', place), text.size() - 1) + 1; }
    if (const auto function = find_function(text.substr(std::min(place, text.size())))) {
        place += function->name.size();
    }
    for (int depth = 0; place < text.size(); ++place) {
        const char c = text[place];
        depth += c == '[' ? 1 : c == ']' ? -1 : 0;
        if (depth == 0 && !is_of_number(c)) { return c == ']' ? place + 1 : place; }
    }
    return place;
}

int Reader::parameter_number() {
    const std::size_t begin = at_;
    const double number = value();
    if (!is_parameter(number)) {
        fail(begin, "#" + number_text(number) + " is not a parameter; its number must be from 1 to " +
                        std::to_string(kMaxParameter));
        return 1;
    }
    return static_cast<int>(std::round(number));
}

std::string Reader::name() {
    const std::size_t begin = at_++;
    std::string result;
    while (!done() && peek() != '>') { result += small(next()); }
    if (!take('>')) { fail(begin, "the name is not closed; write > after it"); }
    if (result.empty() && !error_) { fail(begin, "the name is empty; write one between < and >"); }
    return result;
}

double Reader::parameter() {
    const std::size_t begin = at_++;
    if (++nesting_ > kMaxNesting) {
        fail(begin, "parameters of parameters are nested too deep; use another parameter");
    }
    double result = 0;
    if (peek() == '<') {
        const std::string called = name();
        const auto found = error_ ? std::optional(0.0) : parameters_.named(called);
        if (!found) { fail(begin, "#<" + called + "> has no value; assign one before: #<" + called + ">=0"); }
        result = found.value_or(0);
    } else {
        const int number = parameter_number();
        if (number == kInputResult) {
            fail(begin, "#5399, the result of M66, cannot be read: a program is read before it runs; let M66 wait");
        }
        result = parameters_.numbered(number);
    }
    --nesting_;
    return result;
}

double Reader::expression() {
    const std::size_t begin = at_;
    if (!take('[')) {
        fail(begin, (done() ? "the line ends" : shown(peek())) + " where [ is expected");
        return 0;
    }
    if (++nesting_ > kMaxNesting) {
        fail(begin, "brackets are nested deeper than " + std::to_string(kMaxNesting) + "; use a parameter");
        return 0;
    }
    const auto letter = std::exchange(letter_, std::nullopt);
    const double result = operand_and_operators(1);
    if (!error_ && !take(']')) {
        fail(at_, (done() ? "the line ends" : shown(peek())) + " where ] or an operator is expected");
    }
    letter_ = letter;
    --nesting_;
    return result;
}

/// Precedence climbing. Operators of one precedence are applied from left to right.
double Reader::operand_and_operators(int least_precedence) {
    double left = value();
    while (!error_) {
        const std::size_t begin = at_;
        const auto op = find_operator(line_.text().substr(at_));
        if (!op || precedence(op->meaning) < least_precedence) { return left; }
        at_ += op->name.size();
        const double right = operand_and_operators(precedence(op->meaning) + 1);
        if (error_) { return 0; }
        const auto result = apply(op->meaning, left, right);
        if (!result || !std::isfinite(*result)) {
            fail(begin, result ? "the result is too large" : text_of(result.error(), op->name));
            return 0;
        }
        left = *result;
    }
    return left;
}

double Reader::function_value(Named<Function> function) {
    const std::size_t begin = at_;
    at_ += function.name.size();
    if (function.meaning == Function::Atan) { return arc_tangent(); }
    if (function.meaning == Function::Exists) { return exists(); }
    const double argument = expression();
    if (error_) { return 0; }
    const auto result = apply(function.meaning, argument);
    if (!result || !std::isfinite(*result)) {
        fail(begin, result ? "the result is too large" : text_of(result.error(), function.name));
    }
    return result.value_or(0);
}

/// ATAN[y]/[x]: from -180 to 180 degrees.
double Reader::arc_tangent() {
    const double y = expression();
    if (!error_ && !take('/')) { fail(at_, "ATAN needs two arguments; write ATAN[y]/[x]"); }
    const double x = error_ ? 1 : expression();
    return std::atan2(y, x) * kDegrees;
}

/// Every numbered parameter exists. A named one exists after its assignment.
double Reader::exists() {
    const std::size_t begin = at_++;  // value() has seen the [
    if (!take('#')) {
        fail(begin, "EXISTS needs a parameter; write EXISTS[#<name>] or EXISTS[#1]");
        return 0;
    }
    const bool found = peek() == '<' ? parameters_.named(name()).has_value() : is_parameter(value());
    if (!take(']')) { fail(at_, "EXISTS is not closed; write ]"); }
    return found ? 1 : 0;
}

}  // namespace lockstep::gcode
