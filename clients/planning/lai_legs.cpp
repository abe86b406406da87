#include "clients/planning/lai_legs.hpp"

#include <vector>

#include "core/coordinator/path/lai_frames.hpp"

namespace lockstep {
namespace {

void plan_move(const MachineConfig& machine, const std::shared_ptr<const ProgramBlocks>& blocks, const PathMove& move,
               PlanTotals& totals) {
    LaiFrames frames(machine, blocks, {move}, {}, {.block = move.block + 1, .to = move.to});
    frames.resume({move.block, {}}, positions_of(move.from), {});
    while (!frames.is_done()) { totals.take(**frames.next(), frames.begins()); }
}

}  // namespace

std::expected<PlannedTotals, PlanError> plan_lai_legs(const MachineConfig& machine,
                                                      const std::shared_ptr<const ProgramBlocks>& blocks,
                                                      const AxisCounts& start,
                                                      const std::function<void(Ticks)>& progress) {
    const ProgramPlanner planner(machine);
    const auto axes = planner.axes_of(blocks->axes()).value();
    PlanTotals totals(machine, start);
    PlannedTotals planned;
    AxisCounts at = start;
    for (std::uint32_t number = 0; !blocks->ends_before(number); ++number) {
        const Block* const block = blocks->block(number);
        if (block == nullptr) { break; }
        if (ends_leg(*block)) {
            totals.end_leg();
            planned.pauses += end_by(*block) == LegEnd::Kind::Pause ? 1 : 0;
            continue;
        }
        const auto move = planner.move_of(*block, number, axes, at);
        if (!move) { return std::unexpected(move.error()); }
        if (!*move) { continue; }
        plan_move(machine, blocks, **move, totals);
        if (progress) { progress(totals.duration()); }
    }
    totals.end_leg();
    planned.duration = totals.duration();
    planned.axes = totals.axes();
    return planned;
}

}  // namespace lockstep
