// The planned motion of a program's legs, computed from the same frames that the coordinator makes.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/coordinator/path/program_plan.hpp"
#include "core/step/segment.hpp"

namespace lockstep {

/// The pieces of an axis in order. Times count from the leg's begin.
class AxisMotion {
public:
    struct TimedPiece {
        Ticks begin;
        Position from;
        Piece piece;
    };

    explicit AxisMotion(Position from) : to_(from) {}

    /// Where it ends.
    Position to() const { return to_; }
    void add(const Piece& piece);
    /// Drops the pieces that end by `t`. Do not call at() for earlier times afterwards.
    void forget_before(Ticks t);

    const std::deque<TimedPiece>& pieces() const { return pieces_; }
    Position at(Ticks t) const;

private:
    std::deque<TimedPiece> pieces_;
    Position to_;
    Ticks end_;
};

/// A move of the program, or a dwell.
struct PlannedMove {
    std::optional<std::int32_t> line;
    std::uint32_t block = 0;
    double length_mm = 0;  // 0 for a dwell
    Ticks begin;           // the move lasts until the next one begins
};

struct LegPlan {
    std::deque<PlannedMove> moves;
    std::vector<AxisMotion> axes;
    Ticks duration;

    Ticks end(std::size_t move) const { return move + 1 < moves.size() ? moves[move + 1].begin : duration; }
    /// The axis's position in steps when a move begins and when it ends. On a joined path it is less than a step from
    /// the program's position.
    std::int64_t from(std::size_t move, AxisIndex axis) const { return axes[axis].at(moves[move].begin).count(); }
    std::int64_t to(std::size_t move, AxisIndex axis) const { return axes[axis].at(end(move)).count(); }
};

/// Plans the legs in which an axis moves or the program dwells. A leg goes from rest to rest; between two legs the
/// program waits for a person. Fails like ProgramPlanner::plan, or if the axes' limits contradict each other.
std::expected<std::vector<LegPlan>, PlanError> plan_legs(const MachineConfig& machine, const Program& program,
                                                         const AxisCounts& start);

/// The totals of a program of any length: each move is dropped once it has been visited.
struct PlannedLegs {
    std::int64_t legs = 0;
    Ticks duration;
};
/// `leg` is a part of the leg's plan. Its first move is the visited one; its duration is that of the motion planned so
/// far. `plays`: of all motors at the start, if one has backlash; empty: 0.
using OnPlannedMove = std::function<void(const LegPlan& leg)>;
std::expected<PlannedLegs, PlanError> each_planned_move(const MachineConfig& machine, const ProgramHead& head,
                                                        const std::shared_ptr<const ProgramBlocks>& blocks,
                                                        const AxisCounts& start, const OnPlannedMove& visit,
                                                        AxisCounts plays = {});

}  // namespace lockstep
