#include "core/number_text.hpp"

#include <array>
#include <charconv>

namespace lockstep {
namespace {

std::string with_digits(double value, int digits) {
    std::array<char, 32> text{};
    const auto result = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits);
    return {text.begin(), result.ptr};
}

}  // namespace

std::string number_text(double value) { return with_digits(value, 9); }

std::string short_number(double value) { return with_digits(value, 6); }

}  // namespace lockstep
