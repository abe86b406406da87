#include "clients/methods/move_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <ranges>
#include <vector>

namespace lockstep::comparison {
namespace {

template <typename Number>
bool read(std::string_view text, Number& value) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && stop == text.data() + text.size();
}

std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    for (const auto part : std::views::split(text, ',')) { parts.emplace_back(part.begin(), part.end()); }
    return parts;
}

}  // namespace

std::expected<StepMove, std::string> parse_move(std::string_view text) {
    const auto refused = [&](const std::string& why) {
        return std::unexpected(
            fmt::format("'{}': {}; write STEPS,START,MAX,ACCEL[,DECEL], such as {}", text, why, kDefaultMove));
    };
    const auto parts = split(text);
    if (parts.size() != 4 && parts.size() != 5) { return refused("a move has four or five numbers"); }
    StepMove move;
    if (!read(parts[0], move.steps)) { return refused("STEPS must be a whole number"); }
    bool numbers = read(parts[1], move.start) && read(parts[2], move.max) && read(parts[3], move.acceleration);
    move.deceleration = move.acceleration;
    if (parts.size() == 5) { numbers = numbers && read(parts[4], move.deceleration); }
    if (!numbers) { return refused("START, MAX, ACCEL and DECEL must be numbers"); }
    if (auto valid = methods::check(move); !valid) { return refused(text_of(valid.error())); }
    return move;
}

std::string move_text(const StepMove& move) {
    const std::string falling =
        move.deceleration == move.acceleration ? "" : fmt::format(" and {} down", move.deceleration);
    return fmt::format("{} steps, {} to {} steps/s, {}{} steps/s²", move.steps, move.start, move.max, move.acceleration,
                       falling);
}

}  // namespace lockstep::comparison
