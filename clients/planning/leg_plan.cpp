#include "clients/planning/leg_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

/// The moves and dwells of a leg, in order.
class MoveReader {
public:
    MoveReader(const ProgramPlanner& planner, const ProgramBlocks& blocks, const Leg& leg)
        : planner_(planner),
          blocks_(blocks),
          axes_(planner.axes_of(blocks.axes()).value()),
          next_(leg.first),
          end_(leg.end),
          at_(leg.from) {}

    /// Returns nullopt after the last move.
    std::optional<PlannedMove> read() {
        while (next_ < end_) {
            const std::uint32_t number = next_++;
            const Block* block = blocks_.block(number);
            if (block == nullptr) { return std::nullopt; }
            const auto move = planner_.move_of(*block, number, axes_, at_).value();
            if (move) { return PlannedMove{move->line, move->block, move->lead == 0 ? 0 : move->length_mm, {}}; }
        }
        return std::nullopt;
    }

private:
    const ProgramPlanner& planner_;
    const ProgramBlocks& blocks_;
    std::vector<AxisIndex> axes_;
    std::uint32_t next_;
    std::uint32_t end_;
    AxisCounts at_;
};

class LegPlanner {
public:
    LegPlanner(const ProgramPlanner& planner, const Kinematics& kinematics,
               const std::shared_ptr<const ProgramBlocks>& blocks, const Leg& leg, const AxisCounts& plays = {})
        : source_(planner.frames(blocks, leg.first, leg.from)), moves_(planner, *blocks, leg), waiting_(moves_.read()) {
        std::vector<Position> at;
        for (const std::int64_t count : kinematics.motors_at(leg.from).steps) {
            const MotorIndex motor{at.size()};
            at.push_back(Position::steps(count + (motor < plays.size() ? plays[motor] : 0)));
            plan_.axes.emplace_back(at.back());
        }
        source_->resume({leg.first, {}}, at, {});
    }

    /// With `visit`, each move is visited and dropped when the next one has begun.
    std::expected<LegPlan, PlanError> run(const OnPlannedMove& visit) {
        for (source_->read_ahead(); !source_->is_done(); source_->read_ahead()) {
            const auto frame = source_->next();
            if (!frame) {
                return std::unexpected(PlanError{FaultCode::FrameBeyondLimits, source_->line_of(frame.error().at.block),
                                                 "no motion from rest can keep the limits of all axes here"});
            }
            take(**frame);
            if (visit) { pass_moves(visit, 1); }
        }
        while (waiting_) { begin_move(plan_.duration); }
        if (visit) { pass_moves(visit, 0); }
        return std::move(plan_);
    }

private:
    void begin_move(Ticks at) {
        waiting_->begin = at;
        plan_.moves.push_back(*std::exchange(waiting_, moves_.read()));
    }

    /// The source lists begins in the order of the moves.
    void take(const PathFrame& frame) {
        for (const MoveBegin& begin : source_->begins()) {
            const Ticks at = plan_.duration + Ticks{std::llround(begin.at)};
            while (waiting_ && waiting_->block <= begin.block) { begin_move(at); }
        }
        for (std::size_t i = 0; i < plan_.axes.size(); ++i) {
            for (const Piece& piece : frame.axes[i].body) { plan_.axes[i].add(piece); }
        }
        plan_.duration += frame.ticks;
    }

    void pass_moves(const OnPlannedMove& visit, std::size_t keep) {
        while (plan_.moves.size() > keep) {
            visit(plan_);
            plan_.moves.pop_front();
            if (plan_.moves.empty()) { return; }
            for (AxisMotion& axis : plan_.axes) { axis.forget_before(plan_.moves.front().begin); }
        }
    }

    std::unique_ptr<FrameSource> source_;
    MoveReader moves_;
    std::optional<PlannedMove> waiting_;  // the next move to begin
    LegPlan plan_;
};

}  // namespace

void AxisMotion::add(const Piece& piece) {
    pieces_.push_back({end_, to_, piece});
    to_ = to_ + piece.covered();
    end_ += piece.ticks;
}

void AxisMotion::forget_before(Ticks t) {
    while (!pieces_.empty() && pieces_.front().begin + pieces_.front().piece.ticks <= t) { pieces_.pop_front(); }
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
    const ProgramPlanner planner(machine);
    const Kinematics kinematics(machine);
    const auto legs = planner.plan(program, start);
    if (!legs) { return std::unexpected(legs.error()); }
    const auto blocks = std::make_shared<WholeProgram>(borrowed(program));
    std::vector<LegPlan> plans;
    for (const Leg& leg : *legs) {
        if (!leg.moves) { continue; }
        auto plan = LegPlanner(planner, kinematics, blocks, leg).run({});
        if (!plan) { return std::unexpected(plan.error()); }
        plans.push_back(*std::move(plan));
    }
    return plans;
}

std::expected<PlannedLegs, PlanError> each_planned_move(const MachineConfig& machine, const ProgramHead& head,
                                                        const std::shared_ptr<const ProgramBlocks>& blocks,
                                                        const AxisCounts& start, const OnPlannedMove& visit,
                                                        AxisCounts plays) {
    const ProgramPlanner planner(machine);
    const Kinematics kinematics(machine);
    const auto legs = planner.plan(head, *blocks, start);
    if (!legs) { return std::unexpected(legs.error()); }
    PlannedLegs planned;
    for (const Leg& leg : *legs) {
        if (!leg.moves) { continue; }
        const auto plan = LegPlanner(planner, kinematics, blocks, leg, plays).run(visit);
        if (!plan) { return std::unexpected(plan.error()); }
        const MotorCounts slides = kinematics.motors_at(leg.to);
        for (const MotorIndex m : motor_indices(plays.size())) { plays[m] = plan->axes[m].to().count() - slides[m]; }
        ++planned.legs;
        planned.duration += plan->duration;
    }
    return planned;
}

}  // namespace lockstep
