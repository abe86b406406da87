#include "clients/session/job_plan.hpp"

#include <utility>

#include "clients/planning/leg_plan.hpp"

namespace lockstep {

std::expected<std::vector<double>, Failure> start_places(Session& session) {
    if (auto reached = session.reach_axes(); !reached) { return std::unexpected(reached.error()); }
    std::vector<double> start_mm;
    for (std::size_t i = 0; i < session.config().axes.size(); ++i) {
        const auto count = static_cast<double>(session.axis(i)->state.position.count());
        start_mm.push_back(to_mm(session.config().axes[i], count));
    }
    return start_mm;
}

std::expected<double, Failure> planned_seconds(const Session& session, const Program& program,
                                               const std::vector<double>& start_mm) {
    const MachineConfig& machine = session.config();
    const Overrides overrides = session.state() ? session.state()->state.overrides : Overrides{};
    AxisCounts start;
    for (std::size_t i = 0; i < start_mm.size(); ++i) { (void)start.push_back(to_steps(machine.axes[i], start_mm[i])); }
    const auto legs = plan_legs(machine, program, start, overrides);
    if (!legs) {
        return std::unexpected(
            bad_file(program.name, {{legs.error().line, legs.error().line > 0 ? 1 : 0, legs.error().text}}));
    }
    Ticks duration;
    for (const LegPlan& leg : *legs) { duration += leg.duration; }
    return static_cast<double>(duration.value) / machine.ticks_per_second();
}

}  // namespace lockstep
