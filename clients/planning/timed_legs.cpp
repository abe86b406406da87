#include "clients/planning/timed_legs.hpp"

#include <cmath>

#include "core/coordinator/path/program_moves.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/path/timing/path_timer.hpp"

namespace lockstep {
namespace {

Ticks rounded_up(double ticks) { return {static_cast<std::int64_t>(std::ceil(ticks - 0x1p-20))}; }

std::vector<std::int64_t> motors_at(const MachineConfig& machine, const AxisCounts& axes) {
    const MotorCounts motors = Kinematics(machine).motors_at(axes);
    return {motors.steps.begin(), motors.steps.begin() + moving_motor_count(machine)};
}

class LegTimer {
public:
    LegTimer(const MachineConfig& machine, std::shared_ptr<const ProgramBlocks> blocks, const AxisCounts& start,
             const Overrides& overrides, const std::function<void(Ticks)>& progress)
        : blocks_(std::move(blocks)),
          axes_(ProgramPlanner(machine).axes_of(blocks_->axes()).value()),
          overrides_(overrides),
          progress_(progress),
          moves_(machine),
          timer_(path_setup_of(machine)),
          load_(motors_at(machine, start)) {}

    LegEnd time(std::uint32_t first, const AxisCounts& from) {
        constexpr std::uint32_t kBlocksBetween = 1024;  // calls of progress
        moves_.begin(blocks_, axes_, first, from);
        timer_.begin(positions_of(from), overrides_, load_);
        while (!moves_.read(timer_).ends) {
            if (progress_ && moves_.next() % kBlocksBetween == 0) { progress_(duration_ + rounded_up(timer_.ticks())); }
        }
        duration_ += rounded_up(timer_.ticks());
        return moves_.end();
    }

    Ticks duration() const { return duration_; }
    const PathLoad& load() const { return load_; }

private:
    std::shared_ptr<const ProgramBlocks> blocks_;
    std::vector<AxisIndex> axes_;
    Overrides overrides_;
    const std::function<void(Ticks)>& progress_;
    ProgramMoves moves_;
    PathTimer timer_;
    PathLoad load_;
    Ticks duration_;
};

AxisPlan plan_of(const std::string& of, const MotorConfig& axis, const AxisLoad& load, double ticks_per_s) {
    const double mm_s = ticks_per_s / axis.steps_per_mm;
    return {.axis = of,
            .name = axis.name,
            .steps = load.steps,
            .peak_velocity_mm_s = load.peak_velocity * mm_s,
            .peak_acceleration_mm_s2 = load.peak_acceleration * mm_s * ticks_per_s,
            .peak_jump_mm_s = load.peak_jump * mm_s,
            .min_mm = to_mm(axis, static_cast<double>(load.least)),
            .max_mm = to_mm(axis, static_cast<double>(load.greatest))};
}

}  // namespace

PlannedTotals time_legs(const MachineConfig& machine, const std::shared_ptr<const ProgramBlocks>& blocks,
                        const AxisCounts& start, const Overrides& overrides,
                        const std::function<void(Ticks)>& progress) {
    LegTimer timer(machine, blocks, start, overrides, progress);
    PlannedTotals totals;
    AxisCounts at = start;
    for (std::uint32_t first = 0; !blocks->ends_before(first);) {
        const LegEnd end = timer.time(first, at);
        totals.pauses += end.kind == LegEnd::Kind::Pause ? 1 : 0;
        at = end.to;
        first = end.block + 1;
    }
    totals.duration = timer.duration();
    const std::vector<MotorConfig> motors = moving_motors_of(machine);
    for (std::size_t m = 0; m < motors.size(); ++m) {
        totals.axes.push_back(
            plan_of(machine.axes[*motors[m].axis].name, motors[m], timer.load().axes()[m], machine.ticks_per_second()));
    }
    return totals;
}

}  // namespace lockstep
