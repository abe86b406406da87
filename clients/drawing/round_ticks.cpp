#include "clients/drawing/round_ticks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace lockstep::drawing {
namespace {

constexpr std::string_view kMinus = "\u2212";
constexpr std::string_view kThinSpace = "\u2009";

/// A step of 1, 2 or 5 times a power of ten, and the decimals its multiples need.
struct Step {
    double size = 1;
    int decimals = 0;
};

Step round_step(double rough) {
    const double exponent = std::floor(std::log10(rough));
    const double power = std::pow(10.0, exponent);
    const double lead = rough / power;
    const double factor = lead < 1.5 ? 1 : (lead < 3.5 ? 2 : (lead < 7.5 ? 5 : 10));
    const double shift = factor == 10 ? 1 : 0;
    return {factor * power, static_cast<int>(std::max(0.0, -(exponent + shift)))};
}

/// Separates thousands in numbers of five digits or more.
std::string group_thousands(std::string_view digits) {
    const std::size_t whole = std::min(digits.find('.'), digits.size());
    std::string out;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (whole > 4 && i > 0 && i < whole && (whole - i) % 3 == 0) { out += kThinSpace; }
        out += digits[i];
    }
    return out;
}

std::string label_of(double value, const Step& step) {
    std::array<char, 400> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), std::abs(value),
                                            std::chars_format::fixed, std::min(step.decimals, 20));
    if (error != std::errc{}) { return {}; }
    const std::string digits = group_thousands({text.data(), end});
    return value < 0 ? std::string(kMinus) + digits : digits;
}

}  // namespace

std::vector<AxisTick> round_ticks(Range range, int wanted) {
    const Step step = round_step(range.span() / std::max(1, wanted));
    const double first = std::ceil(range.low / step.size - 1e-9);
    const int most = 2 * std::max(1, wanted) + 2;
    std::vector<AxisTick> ticks;
    for (int i = 0; i < most; ++i) {
        const double value = (first + i) * step.size + 0.0;
        if (value > range.high + step.size * 1e-9) { break; }
        ticks.push_back({value, label_of(value, step)});
    }
    return ticks;
}

}  // namespace lockstep::drawing
