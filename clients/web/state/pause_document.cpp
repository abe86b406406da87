#include "clients/web/state/pause_document.hpp"

#include <algorithm>

#include "clients/web/state/axis_document.hpp"
#include "core/coordinator/path/return_way.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

constexpr int kDigits = 4;

/// The moves of the way back, each with the axes that move. Empty if they are at the place, or one was never received.
json way_json(const Snapshot& snapshot, const MachinePause& pause, const MachineConfig& machine) {
    json moves = json::array();
    const bool has_all = snapshot.axes.size() == machine.axes.size() && pause.place.size() == machine.axes.size() &&
                         std::ranges::all_of(snapshot.axes, [](const auto& axis) { return axis.state.has_value(); });
    if (!has_all) { return moves; }
    std::vector<std::int64_t> here;
    for (const AxisSnapshot& axis : snapshot.axes) { here.push_back(axis.state->value.position.count()); }
    const Program way = return_way(machine, here, {pause.place.begin(), pause.place.end()});
    std::vector<double> at = way.start_mm;
    for (const Block& block : way.blocks) {
        const auto& to = std::get<ProgramMove>(block.action).target_mm;
        json move = json::object();
        for (std::size_t i = 0; i < to.size(); ++i) {
            if (to[i] != at[i]) { move[way.axes[i]] = rounded(to[i], kDigits); }
        }
        moves.push_back(move);
        at = to;
    }
    return moves;
}

}  // namespace

json pause_document(const Snapshot& snapshot, const MachineConfig& machine) {
    if (!snapshot.machine || !snapshot.machine->value.pause) { return {}; }
    const MachinePause& pause = *snapshot.machine->value.pause;
    const bool has_tool = pause.why.reason == PauseReason::ToolChange;
    const bool waits = pause.why.reason == PauseReason::Input;
    return {{"reason", name_of(pause.why.reason)},
            {"tool", has_tool ? json(pause.why.tool) : json()},
            {"message", pause.why.text},
            {"wait_left_s", waits ? json(rounded(pause.wait_left_s, 1)) : json()},
            {"way", way_json(snapshot, pause, machine)}};
}

}  // namespace lockstep::web
