#include "clients/lockstep/offline/plan_text.hpp"

#include <array>
#include <cstdio>

#include "clients/lockstep/live/words.hpp"

namespace lockstep {
namespace {

std::string places(const ProgramInput& input) {
    std::string text;
    for (std::size_t i = 0; i < input.machine.axes.size(); ++i) {
        text += " " + input.machine.axes[i].name + "=" + fixed(input.plan.start_mm[i], 3);
    }
    return text;
}

std::string row(const AxisPlan& axis) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "\n%-16s %12lld %12.2f %14.0f %12.3f %12.3f", axis.name.c_str(),
                  static_cast<long long>(axis.steps), axis.peak_velocity_mm_s, axis.peak_acceleration_mm_s2,
                  axis.min_mm, axis.max_mm);
    return text.data();
}

}  // namespace

std::string plan_text(const ProgramInput& input) {
    const ProgramPlan& plan = input.plan;
    std::string text = plan.program + " on machine " + input.machine.name + ", from" + places(input) + "\n";
    text += "  duration  " + duration_text(plan.duration_s) + " (" + fixed(plan.duration_s, 6) + " s)";
    if (plan.pauses > 0) { text += ", and what its " + std::to_string(plan.pauses) + " pauses take"; }
    text += "\n  length    " + fixed(plan.length_mm, 3) + " mm along the path\n";
    text += "  moves     " + std::to_string(plan.moves) + ", of " + std::to_string(input.lines) + " lines\n\n";
    std::array<char, 160> head{};
    std::snprintf(head.data(), head.size(), "%-16s %12s %12s %14s %12s %12s", "axis", "steps", "peak mm/s",
                  "peak mm/s2", "from mm", "to mm");
    text += head.data();
    for (const AxisPlan& axis : plan.axes) { text += row(axis); }
    return text;
}

}  // namespace lockstep
