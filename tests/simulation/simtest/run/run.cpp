#include "tests/simulation/simtest/run/run.hpp"

#include "services/documents/machine_rules.hpp"
#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/epoch_runs.hpp"
#include "tests/simulation/simtest/record/publication.hpp"
#include "tests/simulation/simtest/run/play/play.hpp"
#include "tests/simulation/simtest/run/trace.hpp"

namespace lockstep::simtest {
namespace {

/// A machine that no configuration could describe proves nothing.
Violations check_configuration(const MachineConfig& machine) {
    std::vector<Problem> problems = machine_problems(MachineSetup{machine});
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        for (Problem& problem : axis_problems(machine, i)) { problems.push_back(std::move(problem)); }
        for (Problem& problem : motor_problems(machine, i)) { problems.push_back(std::move(problem)); }
    }
    for (Problem& problem : kinematics_problems(machine)) { problems.push_back(std::move(problem)); }
    for (Problem& problem : input_problems(machine)) { problems.push_back(std::move(problem)); }
    for (Problem& problem : output_problems(machine)) { problems.push_back(std::move(problem)); }
    Violations violations;
    for (const Problem& problem : problems) { violations.push_back({"configuration", {}, {}, {}, problem.message}); }
    return violations;
}

}  // namespace

RunResult run_seed(std::uint64_t seed, const RunOptions& options) {
    const Scenario scenario = draw_scenario(seed, options.faults, options.machine);
    RunResult result{.violations = check_configuration(scenario.machine)};
    if (!result.violations.empty()) { return result; }
    Trace trace(scenario.machine);
    PublicationHash published;
    std::vector<VirtualObserver*> also{&published};
    if (options.trace) { also.push_back(&trace); }
    Played played = play(scenario, also);
    const Recording& recording = played.recording;
    result.violations = std::move(played.violations);
    result.fault = recording.fault;
    result.coverage = std::move(played.coverage);
    for (const auto& [number, runs] : epoch_runs(recording)) { result.parted += runs.apart ? 1 : 0; }
    append(result.violations, check_all(recording));
    result.steps = recording.steps();
    result.hash = recording.hash();
    result.published = published.value();
    result.simulated_s =
        static_cast<double>((recording.ended - recording.began).value) / scenario.machine.ticks_per_second();
    if (options.twice && play(scenario).recording.hash() != result.hash) {
        result.violations.push_back({"determinism", {}, {}, {}, "a second run of the same seed made different steps"});
    }
    return result;
}

}  // namespace lockstep::simtest
