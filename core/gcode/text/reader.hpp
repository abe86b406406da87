// Reads the values of a line from left to right: numbers, parameters, expressions in [ ], functions.
//
// The first error is kept and moves the reader to the line's end, so callers need to check only once.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/gcode/text/functions.hpp"
#include "core/gcode/text/line.hpp"
#include "core/gcode/text/parameters.hpp"

namespace lockstep::gcode {

/// The greatest depth of nested brackets and of parameters of parameters.
inline constexpr int kMaxNesting = 64;

class Reader {
public:
    Reader(const Line& line, const Parameters& parameters) : line_(line), parameters_(parameters) {}

    bool done() const { return at_ >= line_.text().size(); }
    std::size_t place() const { return at_; }
    char peek() const { return line_.at(at_); }
    char next() { return line_.at(at_++); }
    bool take(char c);
    bool take(std::string_view word);
    void skip_comment() { at_ = line_.end_of_comment(at_); }
    void go_to(std::size_t place) { at_ = place; }
    /// Goes behind a value without computing it, and returns its text.
    std::string skip_value();

    /// The value of the word with its letter at `letter_at`.
    double word_value(std::size_t letter_at);
    double value();
    /// An expression within [ ].
    double expression();
    /// The name within < >, in small letters.
    std::string name();
    /// The number of a parameter, behind its #.
    int parameter_number();

    void fail(std::size_t place, std::string message) { fail(line_.error(place, std::move(message))); }
    void fail(GcodeError error);
    const std::optional<GcodeError>& error() const { return error_; }

private:
    std::size_t end_of_value(std::size_t place) const;
    double number();
    double parameter();
    double function_value(Named<Function> function);
    double arc_tangent();
    double exists();
    double operand_and_operators(int least_precedence);

    const Line& line_;
    const Parameters& parameters_;
    std::size_t at_ = 0;
    int nesting_ = 0;
    std::optional<std::size_t> letter_;  // of the word that the value belongs to
    std::optional<GcodeError> error_;
};

}  // namespace lockstep::gcode
