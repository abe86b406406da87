#include "clients/session/job_plan.hpp"

#include <utility>

#include "clients/planning/plan_summary.hpp"
#include "clients/session/waits.hpp"

namespace lockstep {

std::expected<std::vector<double>, Failure> start_places(Session& session) {
    if (auto reached = reach_axes(session); !reached) { return std::unexpected(reached.error()); }
    std::vector<double> start_mm;
    for (const AxisIndex i : axis_indices(session.config().axes.size())) {
        const auto count = static_cast<double>(session.received().axis(i)->state.position.count());
        start_mm.push_back(to_mm(session.config().axes[i], count));
    }
    return start_mm;
}

std::expected<double, Failure> planned_seconds(const Session& session, const ProgramHead& head,
                                               std::shared_ptr<const ProgramBlocks> blocks,
                                               const std::vector<double>& start_mm) {
    const MachineConfig& machine = session.config();
    Planning planning;
    if (session.state()) { planning.overrides = session.state()->state.overrides; }
    for (std::size_t i = 0; i < start_mm.size(); ++i) {
        (void)planning.start.push_back(to_steps(machine.axes[i], start_mm[i]));
    }
    const auto plan = plan_blocks(machine, head, std::move(blocks), planning);
    if (plan) { return plan->duration_s; }
    return std::unexpected(
        bad_file(head.name, {{plan.error().line.value_or(0), plan.error().line ? 1 : 0, plan.error().text}}));
}

std::expected<double, Failure> planned_seconds(const Session& session, const Program& program,
                                               const std::vector<double>& start_mm) {
    return planned_seconds(session, program.head(), std::make_shared<WholeProgram>(borrowed(program)), start_mm);
}

}  // namespace lockstep
