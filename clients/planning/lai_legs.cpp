#include "clients/planning/lai_legs.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "core/coordinator/path/lai_periods.hpp"
#include "core/motion/frame_limits.hpp"

namespace lockstep {
namespace {

/// How far and how fast an axis goes, in pulses per period.
class LaiAxisLoad {
public:
    explicit LaiAxisLoad(std::int64_t at) : least_(at), greatest_(at) {}

    /// The next period. `begins`: of a move, or the machine rests.
    void pass(std::int64_t pulses, bool begins) {
        std::int64_t& most = begins ? most_jump_ : most_change_;
        most = std::max(most, std::abs(pulses - last_));
        most_pulses_ = std::max(most_pulses_, std::abs(pulses));
        last_ = pulses;
    }
    /// Several periods, each with the mean of their pulses, rounded up or down.
    void pass_many(std::int64_t pulses, std::int64_t periods) {
        pass(pulses / periods, false);
        if (pulses % periods != 0) { pass(last_ + (pulses < 0 ? -1 : 1), false); }
    }
    void go(std::int64_t from, std::int64_t to) {
        steps_ += std::abs(to - from);
        least_ = std::min(least_, to);
        greatest_ = std::max(greatest_, to);
    }

    AxisPlan plan(const AxisConfig& axis) const {
        constexpr double kPeriod_s = static_cast<double>(kLaiPeriod_ns) * 1e-9;
        const double mm_s = 1 / axis.steps_per_mm / kPeriod_s;
        return {.name = axis.name,
                .steps = steps_,
                .peak_velocity_mm_s = static_cast<double>(most_pulses_) * mm_s,
                .peak_acceleration_mm_s2 = static_cast<double>(most_change_) * mm_s / kPeriod_s,
                .peak_jump_mm_s = static_cast<double>(most_jump_) * mm_s,
                .min_mm = to_mm(axis, static_cast<double>(least_)),
                .max_mm = to_mm(axis, static_cast<double>(greatest_))};
    }

private:
    std::int64_t steps_ = 0;
    std::int64_t least_;
    std::int64_t greatest_;
    std::int64_t last_ = 0;  // pulses of the last period
    std::int64_t most_pulses_ = 0;
    std::int64_t most_change_ = 0;  // from period to period within a move
    std::int64_t most_jump_ = 0;    // from move to move, or to rest
};

class LaiLegTimer {
public:
    LaiLegTimer(const MachineConfig& machine, const AxisCounts& start)
        : limits_(frame_limits_of(machine)), periods_(limits_, machine.tick_ns, LaiFollowing::OnTheLine) {
        for (const std::int64_t count : start) { loads_.emplace_back(count); }
    }

    void pass(const PathMove& move) {
        move.lead == 0 ? dwell(move.dwell) : straight(move);
        for (std::size_t i = 0; i < loads_.size(); ++i) { loads_[i].go(move.from[i], move.to[i]); }
    }
    void rest() {
        for (LaiAxisLoad& load : loads_) { load.pass(0, true); }
    }

    Ticks duration() const { return duration_; }
    const std::vector<LaiAxisLoad>& loads() const { return loads_; }

private:
    void dwell(Ticks ticks) {
        rest();
        duration_ += ticks;
    }

    /// Of the periods with a steady long axis, the first and the last are passed alone, because the changes of speed
    /// beside them count.
    void straight(const PathMove& move) {
        periods_.begin(move);
        for (bool begins = true; periods_.next(); begins = false) {
            for (std::size_t i = 0; i < loads_.size(); ++i) { loads_[i].pass(periods_.pulses()[i], begins); }
            duration_ += periods_.period();
            if (const std::int64_t many = periods_.steady() - 1; many > 1) { pass_many(many); }
        }
    }
    void pass_many(std::int64_t periods) {
        periods_.pass(periods);
        for (std::size_t i = 0; i < loads_.size(); ++i) { loads_[i].pass_many(periods_.pulses()[i], periods); }
        duration_ += Ticks{periods * periods_.period().value};
    }

    std::vector<AxisLimits> limits_;
    LaiPeriods periods_;
    std::vector<LaiAxisLoad> loads_;
    Ticks duration_;
};

}  // namespace

std::expected<PlannedTotals, PlanError> plan_lai_legs(const MachineConfig& machine,
                                                      const std::shared_ptr<const ProgramBlocks>& blocks,
                                                      const AxisCounts& start,
                                                      const std::function<void(Ticks)>& progress) {
    constexpr std::uint32_t kBlocksBetween = 1024;  // calls of progress
    const ProgramPlanner planner(machine);
    const auto axes = planner.axes_of(blocks->axes()).value();
    LaiLegTimer timer(machine, start);
    PlannedTotals planned;
    AxisCounts at = start;
    for (std::uint32_t number = 0; !blocks->ends_before(number); ++number) {
        const Block* const block = blocks->block(number);
        if (block == nullptr) { break; }
        if (ends_leg(*block)) {
            timer.rest();
            planned.pauses += end_by(*block) == LegEnd::Kind::Pause ? 1 : 0;
            continue;
        }
        const auto move = planner.move_of(*block, number, axes, at);
        if (!move) { return std::unexpected(move.error()); }
        if (*move) { timer.pass(**move); }
        if (progress && number % kBlocksBetween == 0) { progress(timer.duration()); }
    }
    timer.rest();
    planned.duration = timer.duration();
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        planned.axes.push_back(timer.loads()[i].plan(machine.axes[i]));
    }
    return planned;
}

}  // namespace lockstep
