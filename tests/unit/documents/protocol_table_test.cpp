// The tables of slots and of touches in docs/protocol.md have the figures that follow from the protocol's rules.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/coordinator/program/probe_check.hpp"
#include "core/protocol/frame_room.hpp"
#include "core/protocol/rules.hpp"
#include "core/protocol/timing.hpp"
#include "services/setup/machine_setup.hpp"

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

/// How long a move keeps its speed behind a touch at most, by the rule that refuses moves that go on too far.
double ms_to_braking(const ProtocolTiming& t) {
    constexpr double kAtOnce = 1e300;
    MachineSetup machine;
    machine.timing = t;
    return 1000 * overshoot_mm(machine, {.debounce_ms = 1}, 1, Braking(kAtOnce));
}

std::vector<std::string> figures_of_a_touch(const ProtocolTiming& t) {
    constexpr double kSpeed_mm_s = 5;
    const double with_stall = ms_to_braking(t);
    const double ms = with_stall - static_cast<double>(t.stall_slots * t.slot_us) / 1000;
    return {fmt::format("{:.0f} ms", ms), fmt::format("{:.0f} ms", with_stall),
            fmt::format("{:.3f} mm", kSpeed_mm_s * ms / 1000)};
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
    const ProtocolTiming usual;
    EXPECT_EQ(most_slots_to_braking(usual), usual.lease_slots() + usual.frame_slots);
    const double by_rules =
        1 + static_cast<double>((most_slots_to_braking(usual) + usual.stall_slots) * usual.slot_us) / 1000;
    EXPECT_LT(by_rules, ms_to_braking(usual)) << "the device is read before the axis decides";
    EXPECT_EQ(figures_of(table[0]), figures_of_a_touch({}));
    EXPECT_EQ(figures_of(table[1]), figures_of_a_touch(with_least_times({.late_check_slots = 10})));
    EXPECT_EQ(figures_of(table[2]),
              figures_of_a_touch(with_least_times({.slot_us = 1000, .stall_slots = 1, .late_check_slots = 0})));
}

}  // namespace
}  // namespace lockstep
