#include "tests/simulation/simtest/run/play_correction.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/kinematics/following_error.hpp"

namespace lockstep::simtest {
namespace {

/// The steps that a motor must make up, signed.
std::int64_t due_steps(const Bench& bench, std::size_t motor) {
    const auto most = most_uncorrected(bench.kinematics().motors()[motor]);
    const std::int64_t slipped = bench.slipped(motor);
    return most && std::abs(slipped) > *most ? -slipped : 0;
}

double longest_seconds(const Bench& bench, const Counts& due) {
    double longest = bench.protocol_seconds();
    for (std::size_t m = 0; m < due.size(); ++m) {
        const MotorConfig& motor = bench.kinematics().motors()[m];
        const double mm = static_cast<double>(std::abs(due[m])) / motor.steps_per_mm;
        longest = std::max(longest, bench.protocol_seconds() + 2 * mm / motor.start_velocity_mm_s);
    }
    return longest;
}

void check(Bench& bench, std::size_t motor, std::int64_t made, std::size_t steps, std::int64_t due) {
    if (made == due && steps == static_cast<std::size_t>(std::abs(due))) { return; }
    bench.object("correction", bench.kinematics().motors()[motor].name + " made " + std::to_string(steps) +
                                   " steps that lead " + std::to_string(made) + " steps far, and should make up " +
                                   std::to_string(due));
}

}  // namespace

bool corrects(const MachineConfig& machine) {
    return std::ranges::any_of(motors_of(machine),
                               [](const MotorConfig& motor) { return most_uncorrected(motor).has_value(); });
}

void play_correction(Bench& bench, JobRecord& job, Counts& at) {
    Counts due;
    std::vector<std::uint32_t> corrected;
    for (std::size_t m = 0; m < at.size(); ++m) {
        due.push_back(due_steps(bench, m));
        corrected.push_back(bench.watch().motors()[m].corrected_steps);
    }
    if (std::ranges::all_of(due, [](std::int64_t steps) { return steps == 0; })) { return; }
    const std::size_t begun = bench.recording().epochs_begun.size();
    const auto is_over = [&] {
        return bench.recording().epochs_begun.size() > begun || bench.watch().outcome().has_value();
    };
    (void)bench.await(is_over, longest_seconds(bench, due), "a correction of lost steps");
    const bool is_undisturbed = !bench.faulted() && !bench.disturbed_since(job.began);
    if (bench.recording().epochs_begun.size() == begun) { bench.settle(longest_seconds(bench, due)); }
    JobRecord alone{.homing = true, .course = {}, .first_step = job.first_step, .began = job.began};
    alone.end_step = job.first_step = bench.steps_made();
    alone.ended = bench.vm().now();
    for (std::size_t m = 0; m < at.size() && !bench.over(); ++m) {
        std::int64_t made = 0;
        for (const StepEdge& step : bench.recording().steps_of(alone, m)) { made += step.direction; }
        const std::size_t steps = alone.end_step[m] - alone.first_step[m];
        const AxisState& state = bench.watch().motors()[m];
        if (is_undisturbed) { check(bench, m, made, steps, due[m]); }
        if (state.corrected_steps == corrected[m]) { continue; }
        bench.forget_slips(m);
        at[m] += made - due[m];
    }
    bench.recording().jobs.push_back(std::move(alone));
}

}  // namespace lockstep::simtest
