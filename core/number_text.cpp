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

std::string grouped(std::int64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t at = text.size(); at > (number < 0 ? 4U : 3U);) {
        at -= 3;
        text.insert(at, " ");
    }
    return text;
}

std::string plural(std::int64_t count, const std::string& one) {
    return grouped(count) + " " + one + (count == 1 ? "" : "s");
}

std::string in_words(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) { text += i + 1 == names.size() ? " and " : ", "; }
        text += names[i];
    }
    return text;
}

}  // namespace lockstep
