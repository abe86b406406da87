#include "core/gcode/text/functions.hpp"

#include <array>
#include <cmath>

#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

constexpr std::array kFunctions{
    Named{"ABS", Function::Abs},   Named{"ACOS", Function::Acos},   Named{"ASIN", Function::Asin},
    Named{"ATAN", Function::Atan}, Named{"COS", Function::Cos},     Named{"EXISTS", Function::Exists},
    Named{"EXP", Function::Exp},   Named{"FIX", Function::Fix},     Named{"FUP", Function::Fup},
    Named{"LN", Function::Ln},     Named{"ROUND", Function::Round}, Named{"SIN", Function::Sin},
    Named{"SQRT", Function::Sqrt}, Named{"TAN", Function::Tan},
};

constexpr std::array kOperators{
    Named{"**", Operator::Power}, Named{"*", Operator::Times}, Named{"/", Operator::Over},  Named{"MOD", Operator::Mod},
    Named{"+", Operator::Plus},   Named{"-", Operator::Minus}, Named{"EQ", Operator::Eq},   Named{"NE", Operator::Ne},
    Named{"GT", Operator::Gt},    Named{"GE", Operator::Ge},   Named{"LT", Operator::Lt},   Named{"LE", Operator::Le},
    Named{"AND", Operator::And},  Named{"OR", Operator::Or},   Named{"XOR", Operator::Xor},
};

/// Two values this near are equal, as in LinuxCNC.
constexpr double kEqual = 1e-4;

template <typename Table>
auto find_in(const Table& table, std::string_view text) -> std::optional<typename Table::value_type> {
    for (const auto& entry : table) {
        if (text.starts_with(entry.name)) { return entry; }
    }
    return std::nullopt;
}

using Why = ArgumentError::Why;

std::unexpected<ArgumentError> wrong(Why why, double argument = 0, double power = 0) {
    return std::unexpected(ArgumentError{why, argument, power});
}

double modulo(double left, double right) {
    const double rest = std::fmod(left, right);
    return rest < 0 ? rest + std::abs(right) : rest;
}

std::expected<double, ArgumentError> power(double left, double right) {
    if (left < 0 && right != std::floor(right)) { return wrong(Why::FractionalPower, left, right); }
    return std::pow(left, right);
}

}  // namespace

std::optional<Named<Function>> find_function(std::string_view text) { return find_in(kFunctions, text); }
std::optional<Named<Operator>> find_operator(std::string_view text) { return find_in(kOperators, text); }

int precedence(Operator op) {
    switch (op) {
        case Operator::Power: return 5;
        case Operator::Times:
        case Operator::Over:
        case Operator::Mod: return 4;
        case Operator::Plus:
        case Operator::Minus: return 3;
        case Operator::And:
        case Operator::Or:
        case Operator::Xor: return 1;
        default: return 2;
    }
}

std::string text_of(const ArgumentError& error, std::string_view name) {
    const auto outside = [&](const char* range) {
        return std::string(name) + " of " + number_text(error.argument) + "; its argument must be " + range;
    };
    switch (error.why) {
        case Why::BeyondOne: return outside("within -1 to 1");
        case Why::NotAboveZero: return outside("above 0");
        case Why::BelowZero: return outside("0 or above");
        case Why::FractionalPower:
            return "a negative number, " + number_text(error.argument) + ", to the power " + number_text(error.power) +
                   "; the power must be whole";
        case Why::DivisionByZero: break;
    }
    return name == "/" ? "a division by 0" : "a division by 0 with " + std::string(name);
}

std::expected<double, ArgumentError> apply(Function function, double x) {
    switch (function) {
        case Function::Abs: return std::abs(x);
        case Function::Acos:
            if (std::abs(x) > 1) { return wrong(Why::BeyondOne, x); }
            return std::acos(x) * kDegrees;
        case Function::Asin:
            if (std::abs(x) > 1) { return wrong(Why::BeyondOne, x); }
            return std::asin(x) * kDegrees;
        case Function::Cos: return std::cos(x / kDegrees);
        case Function::Exp: return std::exp(x);
        case Function::Fix: return std::floor(x);
        case Function::Fup: return std::ceil(x);
        case Function::Ln:
            if (x <= 0) { return wrong(Why::NotAboveZero, x); }
            return std::log(x);
        case Function::Round: return std::round(x);
        case Function::Sin: return std::sin(x / kDegrees);
        case Function::Sqrt:
            if (x < 0) { return wrong(Why::BelowZero, x); }
            return std::sqrt(x);
        case Function::Tan: return std::tan(x / kDegrees);
        case Function::Atan:
        case Function::Exists: break;
    }
    return x;
}

std::expected<double, ArgumentError> apply(Operator op, double left, double right) {
    switch (op) {
        case Operator::Power: return power(left, right);
        case Operator::Times: return left * right;
        case Operator::Over:
            if (right == 0) { return wrong(Why::DivisionByZero); }
            return left / right;
        case Operator::Mod:
            if (right == 0) { return wrong(Why::DivisionByZero); }
            return modulo(left, right);
        case Operator::Plus: return left + right;
        case Operator::Minus: return left - right;
        case Operator::Eq: return std::abs(left - right) < kEqual ? 1 : 0;
        case Operator::Ne: return std::abs(left - right) < kEqual ? 0 : 1;
        case Operator::Gt: return left > right ? 1 : 0;
        case Operator::Ge: return left >= right ? 1 : 0;
        case Operator::Lt: return left < right ? 1 : 0;
        case Operator::Le: return left <= right ? 1 : 0;
        case Operator::And: return left != 0 && right != 0 ? 1 : 0;
        case Operator::Or: return left != 0 || right != 0 ? 1 : 0;
        case Operator::Xor: return (left != 0) != (right != 0) ? 1 : 0;
    }
    return 0;
}

}  // namespace lockstep::gcode
