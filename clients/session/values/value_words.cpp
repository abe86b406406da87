#include "clients/session/values/value_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/session/move_program.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/system_names.hpp"
#include "core/number_text.hpp"
#include "services/documents/program_file.hpp"
#include "services/documents/values/values_document.hpp"

namespace lockstep {
namespace {

using gcode::KeptValues;
using gcode::Point;

constexpr double kMostPlace = 1e6;  // mm or degrees, in both directions
constexpr int kMaxToolNumber = 99'999;

struct Word {
    std::string name;  // in capitals
    double value = 0;
};

std::expected<Word, std::string> read_word(const std::string& text) {
    auto target = parse_target(text);
    if (!target) {
        return std::unexpected("'" + text + "' is not a change; write a letter, = and a number: X=10 or R=30");
    }
    std::ranges::transform(target->axis, target->axis.begin(),
                           [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    if (std::abs(target->mm) > kMostPlace) {
        return std::unexpected(text + " is out of range; it must be from " + number_text(-kMostPlace) + " to " +
                               number_text(kMostPlace));
    }
    return Word{std::move(target->axis), target->mm};
}

Changed set_axis(const MachineConfig& machine, const Word& word, Point& place) {
    const auto axis = find_axis(machine, word.name);
    if (!axis) { return std::unexpected(axis.error()); }
    const auto letter = gcode::axis_place(machine.axes[*axis].name);
    if (!letter) { return std::unexpected("G-code cannot name axis " + word.name + ", so it has no offset"); }
    place[*letter] = word.value;
    return {};
}

/// Calls use(word) for each word until the first error.
template <typename Use>
Changed for_each_word(const ChangeWords& words, Use use) {
    if (words.empty()) { return std::unexpected("there is nothing to set; write for example X=10"); }
    for (const std::string& text : words) {
        const auto word = read_word(text);
        if (!word) { return std::unexpected(word.error()); }
        if (auto used = use(*word); !used) { return used; }
    }
    return {};
}

std::expected<int, std::string> whole(const Word& word, int most) {
    if (word.value >= 0 && word.value <= most && word.value == std::floor(word.value)) {
        return static_cast<int>(word.value);
    }
    return std::unexpected(
        fmt::format("{}={} is not a whole number from 0 to {}", word.name, number_text(word.value), most));
}

std::unexpected<std::string> no_offset(std::string_view name) {
    return std::unexpected("there is no offset '" + std::string(name) +
                           "'; write G54 to G59, G59.1, G59.2, G59.3, G92, G28 or G30");
}

std::string in_capitals(std::string_view name) {
    std::string text(name);
    if (!text.empty() && text[0] == 'g') { text[0] = 'G'; }
    return text;
}

Changed set_tool_word(const MachineConfig& machine, const Word& word, gcode::Tool& tool) {
    constexpr int kMaxOrientation = 9;
    if (word.name == "D") {
        if (word.value < 0) {
            return std::unexpected("D=" + number_text(word.value) + " is not a diameter; it must be 0 or above");
        }
        tool.diameter = word.value;
    } else if (word.name == "P" || word.name == "Q") {
        const auto number = whole(word, word.name == "P" ? kMaxToolNumber : kMaxOrientation);
        if (!number) { return std::unexpected(number.error()); }
        (word.name == "P" ? tool.pocket : tool.orientation) = *number;
    } else {
        return set_axis(machine, word, tool.offset);
    }
    return {};
}

}  // namespace

Changed set_offset(const MachineConfig& machine, std::string_view name, const ChangeWords& words, KeptValues& values) {
    const std::string wanted = in_capitals(name);
    if (const auto system = find_system(wanted)) {
        return for_each_word(words, [&](const Word& word) -> Changed {
            if (word.name != "R") { return set_axis(machine, word, values.systems[*system].origin); }
            values.systems[*system].rotation = word.value;
            return {};
        });
    }
    if (wanted != "G92" && wanted != "G28" && wanted != "G30") { return no_offset(name); }
    std::optional<Point>* const home = wanted == "G28" ? &values.home : wanted == "G30" ? &values.second_home : nullptr;
    if (home != nullptr && !*home) {
        *home = Point{};
        for (const AxisConfig& axis : machine.axes) {
            if (const auto letter = gcode::axis_place(axis.name)) { (**home)[*letter] = axis.homing.park_mm; }
        }
    }
    if (home == nullptr) { values.g92_applies = true; }
    Point& place = home == nullptr ? values.g92 : **home;
    return for_each_word(words, [&](const Word& word) { return set_axis(machine, word, place); });
}

Changed touch_off(const MachineConfig& machine, const std::vector<double>& places_mm, std::string_view name,
                  const ChangeWords& words, KeptValues& values) {
    const auto system = find_system(in_capitals(name));
    if (!system) {
        return std::unexpected("'" + std::string(name) +
                               "' is not a coordinate system; write G54 to G59, G59.1 to G59.3");
    }
    std::string line = fmt::format("G21 G10 L20 P{}", *system + 1);
    const Changed read = for_each_word(words, [&](const Word& word) -> Changed {
        Point place{};
        if (auto known = set_axis(machine, word, place); !known) { return known; }
        line += " " + word.name + number_text(word.value);
        return {};
    });
    if (!read) { return read; }
    GcodeSetup setup = gcode_setup(machine, places_mm, "touch");
    setup.values = values;
    const auto result = read_gcode(line + "\nM2\n", setup);
    if (!result) { return std::unexpected(result.error().front().message); }
    values = result->values;
    return {};
}

Changed clear_offset(std::string_view name, KeptValues& values) {
    const std::string wanted = in_capitals(name);
    const bool all = wanted == "all";
    const auto system = find_system(wanted);
    if (!all && !system && wanted != "G92" && wanted != "G28" && wanted != "G30") { return no_offset(name); }
    if (system) { values.systems[*system] = {}; }
    if (all) { values.systems = {}; }
    if (all || wanted == "G92") {
        values.g92 = {};
        values.g92_applies = false;
    }
    if (all || wanted == "G28") { values.home.reset(); }
    if (all || wanted == "G30") { values.second_home.reset(); }
    return {};
}

Changed set_tool(const MachineConfig& machine, int number, const ChangeWords& words, KeptValues& values) {
    if (!values.tools.contains(number) && values.tools.size() >= gcode::kMaxTools) {
        return std::unexpected(fmt::format(
            "there are {} tools, and the coordinator keeps no more; remove one: lockstep tools remove NUMBER",
            gcode::kMaxTools));
    }
    gcode::Tool& tool = values.tools[number];
    return for_each_word(words, [&](const Word& word) { return set_tool_word(machine, word, tool); });
}

Changed remove_tool(int number, KeptValues& values) {
    if (values.tools.erase(number) > 0) { return {}; }
    return std::unexpected(fmt::format("there is no tool {}; see: lockstep tools", number));
}

}  // namespace lockstep
