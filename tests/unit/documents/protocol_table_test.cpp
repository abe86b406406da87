// The table of slots in docs/protocol.md has the figures that follow from the protocol's inequalities.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "core/protocol/frame_room.hpp"
#include "core/protocol/timing.hpp"

namespace lockstep {
namespace {

/// The cells of the table's rows, each row with its description first.
std::vector<std::vector<std::string>> rows() {
    std::ifstream document("docs/protocol.md");
    std::vector<std::vector<std::string>> found;
    bool is_inside = false;
    for (std::string line; std::getline(document, line);) {
        const bool is_head = line.starts_with("| | slot | s | e | m |");
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

std::vector<std::string> figures_of(const std::vector<std::string>& row) { return {row.begin() + 1, row.end()}; }

TEST(ProtocolTable, HasTheLeastTimesOfEachTiming) {
    const auto table = rows();
    ASSERT_EQ(table.size(), 3U);
    EXPECT_EQ(figures_of(table[0]), figures(ProtocolTiming{})) << "the defaults";
    EXPECT_EQ(figures_of(table[0]), figures(with_least_times(ProtocolTiming{})));
    EXPECT_EQ(figures_of(table[1]), figures(with_least_times({.late_check_slots = 10})));
    EXPECT_EQ(figures_of(table[2]),
              figures(with_least_times({.slot_us = 1000, .stall_slots = 1, .late_check_slots = 0})));
}

}  // namespace
}  // namespace lockstep
