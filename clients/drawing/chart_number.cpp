#include "clients/drawing/chart_number.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace lockstep::drawing {
namespace {

constexpr std::array kPowers{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13};
constexpr std::size_t kDigits = 9;

/// The number of decimals that give a number in [1e-4, 1e9) its digits.
std::size_t decimals_of(double magnitude) {
    std::size_t decimals = kDigits - 1;
    for (; decimals > 0 && magnitude >= kPowers[kDigits - decimals]; --decimals) {}
    for (; magnitude * kPowers[decimals] < kPowers[kDigits - 1] * (1 - 1e-15); ++decimals) {}
    return decimals;
}

}  // namespace

/// As a whole number of its last digit, which costs a fraction of a conversion that reads back the same.
void append_chart_number(std::string& text, double value) {
    const double magnitude = std::abs(value);
    std::array<char, 24> buffer;
    if (magnitude < 1e-4 || magnitude >= 1e9) {
        if (value == 0) { return void(text += '0'); }
        char* const begin = buffer.data();
        text.append(begin, std::to_chars(begin, begin + buffer.size(), value, std::chars_format::general, kDigits).ptr);
        return;
    }
    const std::size_t decimals = decimals_of(magnitude);
    const auto number = static_cast<std::int64_t>(std::llround(magnitude * kPowers[decimals]));
    const char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
    std::string_view digits(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    if (value < 0) { text += '-'; }
    const std::size_t whole = digits.size() > decimals ? digits.size() - decimals : 0;
    text += whole > 0 ? digits.substr(0, whole) : "0";
    std::string_view behind = digits.substr(whole);
    const std::size_t zeros = decimals - behind.size();
    behind = behind.substr(0, behind.find_last_not_of('0') + 1);
    if (behind.empty()) { return; }
    text += '.';
    text.append(zeros, '0') += behind;
}

}  // namespace lockstep::drawing
