#include "tests/simulation/simtest/run/play/play_correction.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/kinematics/following_error.hpp"

namespace lockstep::simtest {
namespace {

std::int64_t due_steps(const Bench& bench, std::size_t motor) {
    const auto most = most_uncorrected(bench.kinematics().motors()[motor]);
    const std::int64_t slipped = bench.slipped(motor);
    return most && std::abs(slipped) > *most ? -slipped : 0;
}

std::int64_t sum_of(std::span<const StepEdge> steps) {
    std::int64_t sum = 0;
    for (const StepEdge& step : steps) { sum += step.direction; }
    return sum;
}

}  // namespace

bool corrects(const MachineConfig& machine) {
    return std::ranges::any_of(motors_of(machine),
                               [](const MotorConfig& motor) { return most_uncorrected(motor).has_value(); });
}

CorrectionPlayer::CorrectionPlayer(Bench& bench) : bench_(bench) {
    for (std::size_t m = 0; m < bench.kinematics().motors().size(); ++m) {
        due_.push_back(due_steps(bench, m));
        corrected_.push_back(bench.watch().motors()[m].corrected_steps);
    }
}

std::optional<Tick> CorrectionPlayer::first_epoch_of(const JobRecord& job) {
    for (const Tick begun : bench_.recording().epochs_begun) {
        if (begun >= job.began) { return begun; }
    }
    return std::nullopt;
}

double CorrectionPlayer::longest_seconds(double streamed_s) const {
    double longest = bench_.protocol_seconds();
    for (std::size_t m = 0; m < due_.size(); ++m) {
        const MotorConfig& motor = bench_.kinematics().motors()[m];
        const double mm = static_cast<double>(std::abs(due_[m])) / motor.steps_per_mm;
        longest = std::max(longest, bench_.protocol_seconds() + 2 * mm / motor.start_velocity_mm_s);
    }
    return longest + streamed_s;
}

void CorrectionPlayer::check(std::size_t motor, std::span<const StepEdge> steps) {
    const std::int64_t due = due_[motor];
    if (sum_of(steps) == due && std::cmp_equal(steps.size(), std::abs(due))) { return; }
    bench_.object("correction", bench_.kinematics().motors()[motor].name + " made " + std::to_string(steps.size()) +
                                    " steps that lead " + std::to_string(sum_of(steps)) +
                                    " steps far, and should make up " + std::to_string(due));
}

/// The answer to the client may come late, so the steps before the first epoch count, whenever it began.
void CorrectionPlayer::play(JobRecord& job, Counts& at, double streamed_s) {
    if (std::ranges::all_of(due_, [](std::int64_t steps) { return steps == 0; })) { return; }
    const auto is_over = [&] {  // the program may begin with a pause
        return first_epoch_of(job) || bench_.watch().outcome() || bench_.watch().phase() == MachinePhase::Paused;
    };
    (void)bench_.await(is_over, longest_seconds(streamed_s), "a correction of lost steps");
    const auto epoch = first_epoch_of(job);
    const bool is_undisturbed = !bench_.faulted() && !bench_.disturbed_since(job.began);
    if (!epoch && (bench_.faulted() || bench_.watch().outcome())) { bench_.settle(longest_seconds(streamed_s)); }
    JobRecord alone{.homing = true, .course = {}, .first_step = job.first_step, .began = job.began};
    alone.end_step = bench_.steps_made();
    for (std::size_t m = 0; m < at.size() && !bench_.over(); ++m) {
        const MotorRecord& motor = bench_.recording().motors[m];
        const auto is_before = [&](const StepEdge& step) { return !epoch || motor.truth(step) < *epoch; };
        std::size_t& end = alone.end_step[m];
        while (end > alone.first_step[m] && !is_before(motor.steps[end - 1])) { --end; }
        const auto steps = bench_.recording().steps_of(alone, m);
        if (is_undisturbed) { check(m, steps); }
        if (bench_.watch().motors()[m].corrected_steps == corrected_[m]) { continue; }
        bench_.forget_slips(m);
        at[m] += sum_of(steps) - due_[m];
    }
    job.first_step = alone.end_step;
    alone.ended = epoch.value_or(bench_.vm().now());
    bench_.recording().jobs.push_back(std::move(alone));
}

}  // namespace lockstep::simtest
