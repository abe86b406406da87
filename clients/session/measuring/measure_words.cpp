#include "clients/session/measuring/measure_words.hpp"

#include <fmt/format.h>

#include <optional>

#include "clients/session/move_program.hpp"
#include "clients/text/format.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

std::optional<std::size_t> axis_of(const std::string& name) {
    if (name == "X" || name == "x") { return 0; }
    if (name == "Y" || name == "y") { return 1; }
    return std::nullopt;
}

std::expected<Way, std::string> way_of(const std::string& word) {
    const auto target = parse_target(word);
    if (!target) { return std::unexpected(target.error()); }
    const auto axis = axis_of(target->axis);
    if (!axis) { return std::unexpected("'" + word + "' names another axis; only X and Y can be given here"); }
    if (target->mm == 0) { return std::unexpected("'" + word + "' is no way; write how far to go, such as X=10"); }
    return Way{*axis, target->mm};
}

/// The ranges of X and Y have the form of two targets: "X=10" and "X=190".
std::expected<Range, std::string> range_of(const std::string& word) {
    const std::size_t colon = word.find(':');
    const std::size_t equals = word.find('=');
    const std::string example = "'" + word + "' is not a range; write an axis, = and two places in mm: X=10:190";
    if (colon == std::string::npos || equals == std::string::npos || colon < equals) {
        return std::unexpected(example);
    }
    const auto from = parse_target(word.substr(0, colon));
    const auto to = parse_target(word.substr(0, equals + 1) + word.substr(colon + 1));
    if (!from || !to) { return std::unexpected(example); }
    if (to->mm <= from->mm) {
        return std::unexpected("'" + word + "' ends where it begins or before it; write the smaller place first");
    }
    return Range{from->mm, to->mm};
}

constexpr const char* kBoth = "write one word for X and one for Y, such as ";

}  // namespace

std::string text_of(const MeasureError& error) {
    return error.option.empty() ? error.text : "--" + error.option + " " + error.text;
}

std::expected<Way, std::string> one_way(const std::vector<std::string>& words) {
    if (words.size() == 1) { return way_of(words.front()); }
    return std::unexpected(
        fmt::format("{} words are given; write one, the farthest way to the edge: X=10 or Y=-10", words.size()));
}

std::expected<std::array<double, 2>, std::string> both_ways(const std::vector<std::string>& words) {
    std::array<double, 2> ways{};
    for (const std::string& word : words) {
        const auto way = way_of(word);
        if (!way) { return std::unexpected(way.error()); }
        ways[way->axis] = way->mm;
    }
    if (words.size() == 2 && ways[0] != 0 && ways[1] != 0) { return ways; }
    return std::unexpected(std::string(kBoth) + "X=10 Y=8: about where the corner is from here");
}

std::expected<std::array<Range, 2>, std::string> both_ranges(const std::vector<std::string>& words) {
    std::array<std::optional<Range>, 2> ranges;
    for (const std::string& word : words) {
        const auto range = range_of(word);
        if (!range) { return std::unexpected(range.error()); }
        const auto axis = axis_of(word.substr(0, word.find('=')));
        if (!axis) { return std::unexpected("'" + word + "' names another axis; only X and Y can be given here"); }
        ranges[*axis] = *range;
    }
    if (words.size() == 2 && ranges[0] && ranges[1]) { return std::array{*ranges[0], *ranges[1]}; }
    return std::unexpected(std::string(kBoth) + "X=10:190 Y=10:90");
}

std::expected<void, MeasureError> check_range(const std::string& option, double value, double least, double most,
                                              const std::string& unit) {
    if (value >= least && value <= most) { return {}; }
    return std::unexpected(MeasureError{option, fmt::format("is {}; it must be from {} to {} {}", number_text(value),
                                                            number_text(least), number_text(most), unit)});
}

}  // namespace lockstep
