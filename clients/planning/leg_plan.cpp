#include "clients/planning/leg_plan.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// Begins are in the order of the moves.
void note_begins(const std::vector<MoveBegin>& begins, Ticks frame, std::size_t& next,
                 std::vector<PlannedMove>& moves) {
    for (const MoveBegin& begin : begins) {
        const Ticks at = frame + Ticks{std::llround(begin.at)};
        for (; next < moves.size() && moves[next].block <= begin.block; ++next) { moves[next].begin = at; }
    }
}

std::vector<PlannedMove> moves_of(const ProgramPlanner& planner, const Program& program, const Leg& leg) {
    std::vector<PlannedMove> moves;
    planner.each_move(program, leg, [&moves](const PathMove& move) {
        moves.push_back({move.line, move.block, move.lead == 0 ? 0 : move.length_mm, {}});
    });
    return moves;
}

std::expected<LegPlan, PlanError> plan_leg(const MachineConfig& machine, const Program& program, const Leg& leg) {
    const ProgramPlanner planner(machine);
    const std::shared_ptr<const Program> borrowed(std::shared_ptr<const Program>{}, &program);
    const auto source = planner.frames(borrowed, leg);
    LegPlan plan{.moves = moves_of(planner, program, leg), .axes = {}, .duration = {}};
    std::vector<Position> at;
    for (const std::int64_t count : leg.from) {
        at.push_back(Position::steps(count));
        plan.axes.emplace_back(at.back());
    }
    source->resume({leg.first, {}}, at, {});
    std::size_t next = 0;
    for (source->read_ahead(); !source->is_done(); source->read_ahead()) {
        const auto frame = source->next();
        if (!frame) {
            return std::unexpected(PlanError{FaultCode::FrameBeyondLimits, program.blocks[frame.error().at.block].line,
                                             "no motion from rest keeps the limits of all axes here"});
        }
        note_begins(source->begins(), plan.duration, next, plan.moves);
        for (std::size_t i = 0; i < at.size(); ++i) {
            for (const Piece& piece : (*frame)->axes[i].body) { plan.axes[i].add(piece); }
        }
        plan.duration += (*frame)->ticks;
    }
    for (; next < plan.moves.size(); ++next) { plan.moves[next].begin = plan.duration; }
    return plan;
}

}  // namespace

void AxisMotion::add(const Piece& piece) {
    pieces_.push_back({end_, to_, piece});
    to_ = to_ + piece.covered();
    end_ += piece.ticks;
}

Position AxisMotion::at(Ticks t) const {
    if (t >= end_) { return to_; }
    const auto behind = std::ranges::upper_bound(pieces_, t, {}, &TimedPiece::begin);
    if (behind == pieces_.begin()) { return pieces_.front().from; }
    const TimedPiece& piece = *(behind - 1);
    return piece.from + piece.piece.covered(t - piece.begin);
}

std::expected<std::vector<LegPlan>, PlanError> plan_legs(const MachineConfig& machine, const Program& program,
                                                         const AxisCounts& start) {
    const auto legs = ProgramPlanner(machine).plan(program, start);
    if (!legs) { return std::unexpected(legs.error()); }
    std::vector<LegPlan> plans;
    for (const Leg& leg : *legs) {
        if (!leg.moves) { continue; }
        auto plan = plan_leg(machine, program, leg);
        if (!plan) { return std::unexpected(plan.error()); }
        plans.push_back(*std::move(plan));
    }
    return plans;
}

}  // namespace lockstep
