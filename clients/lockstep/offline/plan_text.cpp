#include "clients/lockstep/offline/plan_text.hpp"

#include <fmt/format.h>

#include "clients/text/format.hpp"
#include "core/axis_unit.hpp"

namespace lockstep {
namespace {

std::string places(const PlannedFile& input) {
    std::string text;
    for (const AxisIndex i : axis_indices(input.machine.axes.size())) {
        text += " " + input.machine.axes[i].name + "=" + fixed(input.plan.start_mm[i], 3);
    }
    return text;
}

std::string row(const AxisPlan& axis) {
    return fmt::format("\n{:<16} {:>4} {:>12} {:>10.2f} {:>10.0f} {:>10.2f} {:>11.3f} {:>11.3f}", axis.name,
                       unit_of(axis.axis), axis.steps, axis.peak_velocity_mm_s, axis.peak_acceleration_mm_s2,
                       axis.peak_jump_mm_s, axis.min_mm, axis.max_mm);
}

}  // namespace

std::string plan_text(const PlannedFile& input) {
    const ProgramPlan& plan = input.plan;
    std::string text = fmt::format("{} on machine {}, from{}\n", plan.program, input.machine.name, places(input));
    text += "  duration  " + duration_text(plan.duration_s) + " (" + fixed(plan.duration_s, 6) + " s)";
    if (plan.pauses > 0) { text += fmt::format(", and what its {} pauses take", plan.pauses); }
    text += "\n  length    " + fixed(plan.length_mm, 3) + " mm along the path\n";
    text += fmt::format("  moves     {}, of {} lines\n\n", plan.moves, input.lines);
    text += fmt::format("{:<16} {:>4} {:>12} {:>10} {:>10} {:>10} {:>11} {:>11}", "axis", "unit", "steps", "peak /s",
                        "peak /s²", "jump /s", "from", "to");
    for (const AxisPlan& axis : plan.axes) { text += row(axis); }
    return text;
}

}  // namespace lockstep
