#include "core/gcode/number_text.hpp"

#include <array>
#include <charconv>

namespace lockstep {

std::string number_text(double value) {
    std::array<char, 32> text{};
    const auto result = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, 9);
    return {text.begin(), result.ptr};
}

}  // namespace lockstep
