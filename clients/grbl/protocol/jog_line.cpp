#include "clients/grbl/protocol/jog_line.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "clients/grbl/protocol/number.hpp"
#include "core/number_text.hpp"
#include "core/program.hpp"

namespace lockstep::grbl {
namespace {

using Refusal = std::unexpected<Refused>;

struct JogWords {
    std::map<char, double> values;  // axes and F
    std::optional<bool> inches;
    std::optional<bool> relative;
    bool in_machine = false;  // G53
};

/// The text without blanks and comments, in capitals.
std::string plain(std::string_view text) {
    std::string result;
    bool is_comment = false;
    for (const char c : text) {
        if (c == ';') { break; }
        if (c == '(') { is_comment = true; }
        if (!is_comment && std::isspace(static_cast<unsigned char>(c)) == 0) {
            result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        }
        if (c == ')') { is_comment = false; }
    }
    return result;
}

std::expected<void, Refused> take_code(double code, JogWords& words) {
    if (code == 20 || code == 21) {
        words.inches = code == 20;
    } else if (code == 90 || code == 91) {
        words.relative = code == 91;
    } else if (code == 53) {
        words.in_machine = true;
    } else {
        return Refusal({Error::BadJog, "a jog accepts only the codes G20, G21, G53, G90 and G91"});
    }
    return {};
}

std::expected<void, Refused> take_word(char letter, double value, JogWords& words) {
    if (letter == 'G') { return take_code(value, words); }
    if (letter == 'N') { return {}; }
    if (letter != 'F' && std::string_view("XYZABCUVW").find(letter) == std::string_view::npos) {
        return Refusal({Error::BadJog, std::string("a jog accepts only axes, F and G, not ") + letter});
    }
    if (words.values.contains(letter)) {
        return Refusal({Error::RepeatedWord, std::string(1, letter) + " comes twice"});
    }
    words.values[letter] = value;
    return {};
}

std::expected<JogWords, Refused> words_of(std::string_view text) {
    JogWords words;
    const std::string line = plain(text);
    for (std::size_t at = 0; at < line.size();) {
        const char letter = line[at++];
        if (letter < 'A' || letter > 'Z') {
            return Refusal({Error::ExpectedLetter, "a word must begin with a letter"});
        }
        if (at < line.size() && line[at] == '+') { ++at; }
        double value = 0;
        const auto read = std::from_chars(line.data() + at, line.data() + line.size(), value, std::chars_format::fixed);
        if (read.ec != std::errc{} || !std::isfinite(value)) {
            return Refusal({Error::BadNumber, std::string("no number follows ") + letter});
        }
        at = static_cast<std::size_t>(read.ptr - line.data());
        if (auto taken = take_word(letter, value, words); !taken) { return Refusal(taken.error()); }
    }
    return words;
}

struct Way {
    AxisIndex axis;
    double mm = 0;
};

/// The distance of each axis that moves.
std::expected<std::vector<Way>, Refused> ways_of(const JogWords& words, const MachineConfig& machine,
                                                 const std::vector<AxisPlace>& places, const JogModes& modes) {
    const double unit = words.inches.value_or(modes.inches) ? kInch_mm : 1;
    const bool relative = words.relative.value_or(modes.relative) && !words.in_machine;
    std::vector<Way> ways;
    for (const auto& [letter, value] : words.values) {
        if (letter == 'F') { continue; }
        const auto found = machine.axis_named(std::string(1, letter));
        if (!found) { return Refusal({Error::BadJog, std::string("the machine has no axis ") + letter}); }
        const AxisIndex axis = *found;
        const AxisConfig& config = machine.axes[axis];
        const double here = places[axis].mm;
        const double zero = words.in_machine ? 0 : modes.offset_mm[axis];
        const double to = relative ? here + value * unit : zero + value * unit;
        const double half_step = 0.5 / config.steps_per_mm;
        const bool is_within = to >= config.position_min_mm - half_step && to <= config.position_max_mm + half_step;
        if (places[axis].homed && !is_within) {
            return Refusal({Error::TravelExceeded, std::string(1, letter) + " would leave its travel"});
        }
        if (std::abs(to - here) >= half_step) { ways.push_back({axis, to - here}); }
    }
    return ways;
}

}  // namespace

std::expected<std::vector<JogAxis>, Refused> read_jog(std::string_view text, const MachineConfig& machine,
                                                      const std::vector<AxisPlace>& places, const JogModes& modes) {
    const auto words = words_of(text);
    if (!words) { return Refusal(words.error()); }
    const auto feed = words->values.find('F');
    if (words->values.size() == (feed == words->values.end() ? 0U : 1U)) {
        return Refusal({Error::NoAxisWords, "a jog needs an axis"});
    }
    if (feed == words->values.end() || feed->second <= 0) { return Refusal({Error::NoFeed, "a jog needs its own F"}); }
    const auto ways = ways_of(*words, machine, places, modes);
    if (!ways) { return Refusal(ways.error()); }
    double length = 0;
    for (const Way& way : *ways) { length = std::hypot(length, way.mm); }
    double speed = feed->second * (words->inches.value_or(modes.inches) ? kInch_mm : 1) / 60;
    for (const Way& way : *ways) {
        speed = std::min(speed, machine.axes[way.axis].max_velocity_mm_s * length / std::abs(way.mm));
    }
    if (std::ranges::any_of(*ways,
                            [&](const Way& way) { return speed * std::abs(way.mm) / length < kLeastSpeed_mm_s; })) {
        return Refusal({Error::NoFeed, "F is too slow; each axis must move at " + short_number(kLeastSpeed_mm_s * 60) +
                                           " mm/min or more"});
    }
    std::vector<JogAxis> jogs;
    for (const Way& way : *ways) {
        const double share = std::min(speed * way.mm / length, machine.axes[way.axis].max_velocity_mm_s);
        jogs.push_back({way.axis, std::max(share, -machine.axes[way.axis].max_velocity_mm_s), std::abs(way.mm)});
    }
    return jogs;
}

}  // namespace lockstep::grbl
