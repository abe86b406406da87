#include "core/coordinator/path/return_way.hpp"

#include <algorithm>
#include <cmath>

#include "core/axis_unit.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

void add_move(Program& way, const std::vector<double>& from_mm, const std::vector<double>& to_mm) {
    if (from_mm == to_mm) { return; }
    way.blocks.push_back({{}, ProgramMove{.target_mm = to_mm, .rapid = true, .arc = {}, .mode = PathMode::ExactStop}});
}

std::string move_text(const Program& way, const std::vector<double>& from_mm, const std::vector<double>& to_mm) {
    constexpr double kShown = 1e4;  // parts of a mm
    std::string text;
    for (std::size_t i = 0; i < to_mm.size(); ++i) {
        if (to_mm[i] == from_mm[i]) { continue; }
        text += (text.empty() ? "" : " and ") + way.axes[i] + " to " +
                short_number(std::round(to_mm[i] * kShown) / kShown) + " " + std::string(unit_of(way.axes[i]));
    }
    return text;
}

}  // namespace

Program return_way(const MachineConfig& machine, std::span<const std::int64_t> here,
                   std::span<const std::int64_t> place) {
    Program way{.name = "return to the place of the pause", .axes = machine.axis_names(), .start_mm = {}, .blocks = {}};
    std::vector<double> at;
    std::vector<double> end;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        at.push_back(to_mm(machine.axes[i], static_cast<double>(here[i])));
        end.push_back(to_mm(machine.axes[i], static_cast<double>(place[i])));
    }
    way.start_mm = at;
    const auto z = static_cast<std::size_t>(std::ranges::find(way.axes, "Z") - way.axes.begin());
    std::vector<double> above = at;
    std::vector<double> across = end;
    if (z < at.size()) { above[z] = across[z] = std::max(at[z], end[z]); }
    add_move(way, at, above);
    add_move(way, above, across);
    add_move(way, across, end);
    return way;
}

std::string text_of_way(const Program& way) {
    std::string text;
    std::vector<double> at = way.start_mm;
    for (const Block& block : way.blocks) {
        const auto& to = std::get<ProgramMove>(block.action).target_mm;
        text += (text.empty() ? "" : ", then ") + move_text(way, at, to);
        at = to;
    }
    return text;
}

}  // namespace lockstep
