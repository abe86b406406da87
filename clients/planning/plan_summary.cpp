#include "clients/planning/plan_summary.hpp"

#include <algorithm>
#include <utility>

#include "clients/planning/counted_blocks.hpp"
#include "clients/planning/lai_legs.hpp"
#include "clients/planning/timed_legs.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

/// Plans the frames of a program leg by leg, from rest to rest.
class LegByLeg {
public:
    LegByLeg(const MachineConfig& machine, std::shared_ptr<const CountedBlocks> blocks, const Planning& planning)
        : planner_(machine),
          kinematics_(machine),
          blocks_(std::move(blocks)),
          planning_(planning),
          at_(planning.start),
          totals_(machine, planning.start) {}

    /// Fails if the axes' limits contradict each other.
    std::expected<void, PlanError> run() {
        for (std::uint32_t first = 0; !blocks_->ends_before(first);) {
            const auto source = planner_.frames(blocks_, first, at_);
            if (auto planned = plan(*source, first); !planned) { return planned; }
            const LegEnd end = source->end();
            pauses_ += end.kind == LegEnd::Kind::Pause ? 1 : 0;
            at_ = end.to;
            first = end.block + 1;
        }
        return {};
    }

    PlannedTotals totals() const { return {totals_.duration(), pauses_, totals_.axes()}; }

private:
    std::expected<void, PlanError> plan(FrameSource& source, std::uint32_t first) {
        source.resume({first, {}}, positions_of(kinematics_.motors_at(at_).steps), planning_.overrides);
        bool is_first = true;
        for (source.read_ahead(); !source.is_done(); source.read_ahead()) {
            const auto frame = source.next();
            if (!frame) {
                return std::unexpected(PlanError{FaultCode::FrameBeyondLimits, source.line_of(frame.error().at.block),
                                                 "no motion from rest can keep the limits of all axes here"});
            }
            const Ticks begin = totals_.duration();
            totals_.take(**frame, source.begins());
            if (planning_.each_frame) { planning_.each_frame({**frame, begin, std::exchange(is_first, false)}); }
            if (planning_.progress) { planning_.progress(totals_.duration()); }
        }
        totals_.end_leg();
        return {};
    }

    ProgramPlanner planner_;
    Kinematics kinematics_;
    std::shared_ptr<const CountedBlocks> blocks_;
    const Planning& planning_;
    AxisCounts at_;
    PlanTotals totals_;
    int pauses_ = 0;
};

/// Where the axes are when each motor rests on the whole step that is nearest to its park.
AxisCounts parked_counts(const MachineConfig& machine) {
    AxisCounts counts;
    for (const AxisConfig& axis : machine.axes) { counts.append(to_steps(axis, axis.homing.park_mm)); }
    const Kinematics kinematics(machine);
    return kinematics.axes_at(kinematics.motors_at(counts));
}

/// Frames from rest can fail only if an axis reaches its start velocity within a few ticks. Such a machine is planned
/// by frames, so that a program that cannot run is not reported as correct.
bool may_get_stuck(const MachineConfig& machine) {
    constexpr double kTicks = 8;
    return std::ranges::any_of(moving_motors_of(machine), [&](const MotorConfig& motor) {
        const double change_mm_s = std::max(motor.max_accel_mm_s2, motor.max_decel_mm_s2) / machine.ticks_per_second();
        return motor.start_velocity_mm_s < kTicks * change_mm_s;
    });
}

std::expected<PlannedTotals, PlanError> totals_of(const MachineConfig& machine,
                                                  const std::shared_ptr<const CountedBlocks>& blocks,
                                                  const Planning& planning) {
    if (!planning.each_frame && coordination_of(machine).plans_whole) {
        return plan_lai_legs(machine, blocks, planning.start, planning.progress);
    }
    if (!planning.each_frame && !may_get_stuck(machine)) {
        return time_legs(machine, blocks, planning.start, planning.overrides, planning.progress);
    }
    LegByLeg legs(machine, blocks, planning);
    if (auto planned = legs.run(); !planned) { return std::unexpected(planned.error()); }
    return legs.totals();
}

}  // namespace

std::vector<double> parked_mm(const MachineConfig& machine) {
    const AxisCounts counts = parked_counts(machine);
    std::vector<double> places;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        places.push_back(to_mm(machine.axes[i], static_cast<double>(counts[i])));
    }
    return places;
}

AxisCounts start_counts(const MachineConfig& machine, const ProgramHead& program) {
    AxisCounts counts = parked_counts(machine);
    for (std::size_t i = 0; i < program.axes.size(); ++i) {
        const auto axis = machine.axis_named(program.axes[i]);
        if (axis) { counts[*axis] = to_steps(machine.axes[*axis], program.start_mm[i]); }
    }
    return counts;
}

std::expected<ProgramPlan, PlanError> plan_blocks(const MachineConfig& machine, const ProgramHead& head,
                                                  std::shared_ptr<const ProgramBlocks> blocks,
                                                  const Planning& planning) {
    const ProgramPlanner planner(machine);
    if (auto fits = planner.check_start(head, planning.start); !fits) { return std::unexpected(fits.error()); }
    const auto counted =
        std::make_shared<CountedBlocks>(planner, std::move(blocks), planner.axes_of(head.axes).value(), planning.start);
    auto totals = totals_of(machine, counted, planning);
    if (!totals) { return std::unexpected(totals.error()); }
    if (counted->error()) { return std::unexpected(*counted->error()); }
    ProgramPlan plan{.program = head.name,
                     .start_mm = {},
                     .moves = counted->moves(),
                     .pauses = totals->pauses,
                     .duration = totals->duration,
                     .duration_s = static_cast<double>(totals->duration.value) / machine.ticks_per_second(),
                     .length_mm = counted->length_mm(),
                     .axes = std::move(totals->axes)};
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        plan.start_mm.push_back(to_mm(machine.axes[i], static_cast<double>(planning.start[i])));
    }
    return plan;
}

std::expected<ProgramPlan, PlanError> plan_program(const MachineConfig& machine, const Program& program,
                                                   const OnPlannedFrame& each_frame) {
    return plan_blocks(
        machine, program.head(), std::make_shared<WholeProgram>(borrowed(program)),
        {.start = start_counts(machine, program.head()), .overrides = {}, .each_frame = each_frame, .progress = {}});
}

proto::PlanReport to_report(const ProgramPlan& plan, int lines) {
    proto::PlanReport report;
    report.set_program(plan.program);
    report.set_lines(lines);
    report.set_moves(plan.moves);
    report.set_duration_s(plan.duration_s);
    report.set_length_mm(plan.length_mm);
    for (const AxisPlan& axis : plan.axes) {
        proto::AxisPlan& out = *report.add_axes();
        out.set_name(axis.name);
        out.set_steps(axis.steps);
        out.set_peak_velocity_mm_s(axis.peak_velocity_mm_s);
        out.set_peak_acceleration_mm_s2(axis.peak_acceleration_mm_s2);
        out.set_peak_jump_mm_s(axis.peak_jump_mm_s);
        out.set_min_mm(axis.min_mm);
        out.set_max_mm(axis.max_mm);
    }
    return report;
}

}  // namespace lockstep
