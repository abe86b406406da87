// The tables of slots and of touches in docs/protocol.md have the figures that follow from the protocol's rules.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/protocol/frame_room.hpp"
#include "core/protocol/rules.hpp"
#include "core/protocol/timing.hpp"

namespace lockstep {
namespace {

/// The cells of the rows of the table that begins so, each row with its description first.
std::vector<std::vector<std::string>> rows(std::string_view head) {
    std::ifstream document("docs/protocol.md");
    std::vector<std::vector<std::string>> found;
    bool is_inside = false;
    for (std::string line; std::getline(document, line);) {
        const bool is_head = line.starts_with(head);
        if (is_inside && !line.starts_with("|")) { break; }
        if (is_inside && !line.starts_with("|---")) {
            auto& row = found.emplace_back();
            for (std::size_t at = 2; at < line.size();) {
                const std::size_t end = line.find(" |", at);
                row.push_back(line.substr(at, end - at));
                at = end + 3;
            }
        }
        is_inside = is_inside || is_head;
    }
    return found;
}

std::vector<std::string> figures(const ProtocolTiming& t) {
    const auto ms = [&](int slots) { return slots * t.slot_us / 1000; };
    return {fmt::format("{} ms", ms(1)),
            fmt::format("{}", t.stall_slots),
            fmt::format("{}", t.late_check_slots),
            fmt::format("{}", t.freshness_slots),
            fmt::format("{}", t.lease_slots()),
            fmt::format("{}", t.send_ahead_slots),
            fmt::format("{} ms", ms(t.frame_slots)),
            fmt::format("{} to {} ms", ms(t.lease_slots()), ms(t.lease_slots() + t.frame_slots))};
}

/// The most slots from a touch to the start of the frame that it vetoes. The touch comes just after the state of slot
/// 0. Frames start at any slot and one frame apart.
Slot most_slots_to_braking(const ProtocolTiming& t) {
    constexpr Slot kNextState = 1;
    Slot most = 0;
    for (Slot start = 0; start < t.frame_slots; ++start) {
        Slot vetoed = start;
        while (!rules::veto_is_certain(kNextState, vetoed, t)) { vetoed += t.frame_slots; }
        most = std::max(most, vetoed);
    }
    return most;
}

std::vector<std::string> figures_of_a_touch(const ProtocolTiming& t) {
    constexpr std::int64_t kDebounceMs = 1;
    constexpr double kSpeedMmS = 5;
    const auto ms = [&](Slot slots) { return kDebounceMs + slots * t.slot_us / 1000; };
    const Slot most = most_slots_to_braking(t);
    return {fmt::format("{} ms", ms(most)), fmt::format("{} ms", ms(most + t.stall_slots)),
            fmt::format("{:.3f} mm", kSpeedMmS * static_cast<double>(ms(most)) / 1000)};
}

std::vector<std::string> figures_of(const std::vector<std::string>& row) { return {row.begin() + 1, row.end()}; }

TEST(ProtocolTable, HasTheLeastTimesOfEachTiming) {
    const auto table = rows("| | slot | s | e | m |");
    ASSERT_EQ(table.size(), 3U);
    EXPECT_EQ(figures_of(table[0]), figures(ProtocolTiming{})) << "the defaults";
    EXPECT_EQ(figures_of(table[0]), figures(with_least_times(ProtocolTiming{})));
    EXPECT_EQ(figures_of(table[1]), figures(with_least_times({.late_check_slots = 10})));
    EXPECT_EQ(figures_of(table[2]),
              figures(with_least_times({.slot_us = 1000, .stall_slots = 1, .late_check_slots = 0})));
}

TEST(ProtocolTable, HasTheMostTimeFromATouchToTheBeginningOfBraking) {
    const auto table = rows("| | from a touch to the beginning of braking");
    ASSERT_EQ(table.size(), 3U);
    EXPECT_EQ(most_slots_to_braking({}), ProtocolTiming{}.lease_slots() + ProtocolTiming{}.frame_slots);
    EXPECT_EQ(figures_of(table[0]), figures_of_a_touch({}));
    EXPECT_EQ(figures_of(table[1]), figures_of_a_touch(with_least_times({.late_check_slots = 10})));
    EXPECT_EQ(figures_of(table[2]),
              figures_of_a_touch(with_least_times({.slot_us = 1000, .stall_slots = 1, .late_check_slots = 0})));
}

}  // namespace
}  // namespace lockstep
