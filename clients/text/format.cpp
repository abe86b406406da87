#include "clients/text/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "core/axis_unit.hpp"

namespace lockstep {

std::string fixed(double value, int digits) {
    const std::string written = fmt::format("{:.{}f}", value, digits);
    const bool is_minus_zero = written.starts_with('-') && written.find_first_not_of("-0.") == written.npos;
    return is_minus_zero ? written.substr(1) : written;
}

std::string axis_label(const std::string& name) { return is_rotary(name) ? name + " (deg)" : name; }

std::string duration_text(double seconds) {
    if (seconds < 59.95) { return fixed(seconds, 1) + " s"; }
    const long whole = std::lround(std::min(seconds, 1e9));
    return whole < 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                        : fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string wrapped(std::string_view text, std::size_t width, const std::string& indent) {
    std::string lines;
    std::string line;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(text.size(), word.size() + 1));
        if (!line.empty() && line.size() + 1 + word.size() > width) {
            lines += line + "\n";
            line = indent + std::string(word);
        } else {
            line += (line.empty() ? "" : " ") + std::string(word);
        }
    }
    return lines + line;
}

std::string utc_text(std::chrono::system_clock::time_point time) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    std::array<char, 32> text{};
    return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

}  // namespace lockstep
