// The motion that a job's program commands, move by move: curves of the axes as programmed, steps and times of the
// motors as the coordinator plans them. A motor's steps in a move are counted along its curve, so a full circle has
// steps too.
//
// Moves may be joined. Then a move's own steps are those that its part of the joined path makes. After a hold or an
// override, a curve or a joined path may be a step longer or shorter at each reversal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/asked/asked_shape.hpp"
#include "clients/analysis/asked/axis_places.hpp"
#include "clients/analysis/asked/strokes.hpp"
#include "clients/planning/leg_plan.hpp"
#include "core/machine.hpp"
#include "core/program_blocks.hpp"
#include "core/units.hpp"

namespace lockstep::analysis {

/// A line or an arc from one place to another, or a dwell (no steps).
struct AskedMove {
    double length_mm = 0;  // 0 for a dwell
    Ticks planned;         // from end to end
    Ticks stepping;        // part of `planned` from the lead motor's first step to its last
};

class AskedPath {
public:
    /// Only this many first moves have details, because a program may have millions of moves.
    static constexpr std::size_t kDetailed = 5000;

    /// The path of a job without a program (homing), which commands no moves.
    AskedPath() = default;

    /// Plans the program as the coordinator did. The error says why it cannot be planned. `plays`: of all motors where
    /// it begins, if one has backlash; empty: 0.
    static std::expected<AskedPath, std::string> of(const MachineConfig& machine, const ProgramHead& head,
                                                    const std::shared_ptr<const ProgramBlocks>& blocks,
                                                    const AxisCounts& plays = {});

    /// A motor's way from one reversal to the next, in whole steps.
    struct Stroke {
        std::int64_t from = 0;
        std::int64_t to = 0;
        std::uint32_t move = 0;

        int direction() const { return to > from ? 1 : -1; }
        /// Whether the motor makes a step from `count` in `direction` in it.
        bool has(std::int64_t count, int direction) const {
            return direction > 0 ? from <= count && count < to : to < count && count <= from;
        }
    };

    std::size_t size() const { return lines_.size(); }
    /// The program's line with this move; 0: none. A program may have millions of moves.
    std::int32_t line(std::size_t move) const { return lines_[move]; }
    /// The motor with the most steps.
    std::size_t lead(std::size_t move) const { return leads_[move]; }
    /// Null if the move has no details.
    const AskedMove* details(std::size_t move) const { return move < details_.size() ? &details_[move] : nullptr; }
    Ticks planned() const { return planned_; }
    /// The number of motions from rest to rest. Between two of them the program waits for a person.
    std::int64_t legs() const { return legs_; }

    /// The number of the machine's motors; 0 without a program.
    std::size_t motors() const { return starts_.size(); }
    /// Where the motors are before the first move.
    const MotorCounts& starts() const { return starts_; }
    /// Converts counts of the motors to places of the axes; without axes if there is no program.
    const AxisPlaces& places() const { return places_; }
    /// The steps in both directions together.
    std::int64_t steps(std::size_t move, MotorIndex motor) const { return steps_[move * motors() + motor]; }
    /// By how much the steps that a correct job makes in a move may differ from these if it was planned again behind a
    /// hold or an override: 0 for a line from rest to rest.
    std::int64_t slack(std::size_t move, MotorIndex motor) const;
    const std::vector<Stroke>& strokes_of(MotorIndex motor) const { return strokes_[motor]; }
    /// The curve of a move, for all axes of the machine.
    AskedShape shape(std::size_t move) const;
    /// The greatest deviation from the curve that the program allows, of any axis in any move, in mm.
    double tolerance_mm() const { return tolerance_mm_; }

private:
    void add_first(const LegPlan& leg);
    struct StrokeEnds {
        PlannedStroke first;
        PlannedStroke last;
    };
    std::vector<std::optional<StrokeEnds>> note_strokes(const LegPlan& leg, std::uint32_t number);

    MotorCounts starts_;
    AxisPlaces places_;
    std::shared_ptr<const ProgramBlocks> blocks_;
    std::vector<AxisIndex> axes_;         // the machine's axes that the program names
    std::vector<double> rest_mm_;         // of each axis of the machine, where the program begins
    std::vector<std::uint32_t> numbers_;  // of each move's block
    std::vector<std::int32_t> lines_;     // of each move
    std::vector<std::int64_t> steps_;     // of each move and motor
    std::vector<std::uint8_t> leads_;
    std::vector<std::uint8_t> is_exact_;  // lines from rest to rest
    std::vector<AskedMove> details_;
    std::vector<std::vector<Stroke>> strokes_;  // by motor
    double tolerance_mm_ = 0;
    Ticks planned_;
    std::int64_t legs_ = 0;
};

}  // namespace lockstep::analysis
