#include "core/number_text.hpp"

#include <array>
#include <charconv>

namespace lockstep {

std::string number_text(double value, int digits) {
    std::array<char, 32> text{};
    const auto result = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits);
    return {text.begin(), result.ptr};
}

std::string short_number(double value) { return number_text(value, 6); }

}  // namespace lockstep
