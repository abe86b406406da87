// The functions and operators of expressions. Angles are in degrees.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep::gcode {

enum class Function : std::uint8_t { Abs, Acos, Asin, Atan, Cos, Exists, Exp, Fix, Fup, Ln, Round, Sin, Sqrt, Tan };
enum class Operator : std::uint8_t { Power, Times, Over, Mod, Plus, Minus, Eq, Ne, Gt, Ge, Lt, Le, And, Or, Xor };

/// A function or an operator and its name.
template <typename Meaning>
struct Named {
    std::string_view name;
    Meaning meaning;
};

std::optional<Named<Function>> find_function(std::string_view text);
std::optional<Named<Operator>> find_operator(std::string_view text);

/// 1 binds least: AND OR XOR; then comparisons; + and -; * / MOD; ** binds most.
int precedence(Operator op);

/// An error in the arguments of a function or an operator.
struct ArgumentError {
    enum class Why : std::uint8_t { BeyondOne, NotAboveZero, BelowZero, FractionalPower, DivisionByZero };
    Why why;
    double argument = 0;
    double power = 0;
};
/// `name`: of the function or operator.
std::string text_of(const ArgumentError& error, std::string_view name);

/// Not for Atan, which has two arguments, and not for Exists.
std::expected<double, ArgumentError> apply(Function function, double argument);
std::expected<double, ArgumentError> apply(Operator op, double left, double right);

inline constexpr double kDegrees = 57.295779513082320876798154814105;  // per radian

}  // namespace lockstep::gcode
