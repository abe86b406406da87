// Splits a text into lines. A line ends with LF, CR LF, CR CR LF, CR, or the text's end.
#pragma once

#include <algorithm>
#include <string_view>

namespace lockstep::gcode {

/// Calls take(line, number) for each line, numbers from 1, until it returns false.
template <typename Take>
void for_each_line(std::string_view text, Take take) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) { text.remove_prefix(kByteOrderMark.size()); }
    for (int number = 1; !text.empty(); ++number) {
        std::size_t end = std::min(text.find('\n'), text.size());
        const std::size_t carriage = text.substr(0, end).find('\r');
        std::size_t next = end + 1;
        if (carriage != std::string_view::npos) {
            const bool only_returns =
                text.substr(carriage, end - carriage).find_first_not_of('\r') == std::string_view::npos;
            next = only_returns ? next : carriage + 1;
            end = carriage;
        }
        if (!take(text.substr(0, end), number)) { return; }
        text.remove_prefix(std::min(next, text.size()));
    }
}

}  // namespace lockstep::gcode
