// Numbers in the methods' messages: as few digits as say it, at most six.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace lockstep::stepgen {

inline std::string number(double value) {
    std::array<char, 32> text{};
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
    return {text.data(), end};
}

}  // namespace lockstep::stepgen
