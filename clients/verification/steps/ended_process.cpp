#include "clients/verification/steps/ended_process.hpp"

#include <fmt/format.h>

#include "core/number_text.hpp"
#include "services/record/step_batcher.hpp"

namespace lockstep::verification {
namespace {

std::string text_of(StepEdge step, std::int64_t count) {
    return fmt::format("{} to {} at tick {}", step.direction > 0 ? "forward" : "backward", count, step.tick.value);
}

std::string text_of_missing(const LeftSteps& found) {
    std::string text;
    if (found.unrecorded > 0) {
        text += "; " + plural(found.unrecorded, "step") + " before those of the next process are not in the log";
    }
    if (found.missing > 0) {
        text += "; of their course at least " + plural(found.missing, "step") + " are not in the log";
    }
    return text;
}

}  // namespace

void EndedProcess::leave_run() {
    const Run& run = run_.run();
    if (!run_.before() || run_.before()->incarnation != run.incarnation) { unrecorded_ = 0; }
    const std::int64_t steps = run_.pass_unrecorded();
    unrecorded_ += steps;
    if (unrecorded_ > StepBatcher::kMaxSteps) { return differ_unrecorded(unrecorded_); }
    findings_.report(fmt::format("{} after {} are not in the log, because its process ended; with {} it came to {}",
                                 plural(steps, "step"), findings_.last_place(), name_of(run), run.stop_count),
                     steps > 0);
    run_.end();
}

void EndedProcess::leave_steps(const std::vector<SeenStep>& left, std::int64_t first) {
    const std::string what =
        fmt::format("{} from tick {} on belong to no run in the log, because its process ended; ",
                    plural(static_cast<std::int64_t>(left.size()), "step"), left.front().edge.tick.value);
    const std::vector<Course> courses = planned_(left.front().machine);
    if (courses.empty()) { return findings_.add_unknown(what + "there is no plan to compare them with"); }
    const auto& before = run_.before();
    const LeftSteps found =
        compare_left(left, courses, before ? LeftBy{before->incarnation, before->zero_count} : LeftBy{first, {}});
    findings_.all().steps += static_cast<std::int64_t>(found.fit);
    if (found.fit < left.size()) { return differ_from_plan(what, left[found.fit], found); }
    findings_.add_equal(found.fit, left.back().edge.tick);
    if (found.unrecorded > StepBatcher::kMaxSteps) { return differ_unrecorded(found.unrecorded); }
    findings_.report(what + "they are as planned: " + found.runs + text_of_missing(found),
                     found.missing + found.unrecorded > 0);
}

void EndedProcess::differ_from_plan(const std::string& what, const SeenStep& seen, const LeftSteps& found) {
    const auto& [run, expected, count] = *found.misfit;
    const auto tick = expected ? std::optional(expected->tick) : std::nullopt;
    findings_.differ(fmt::format("{}they are not as planned: after {} that are, the log has one {}, {} {}", what,
                                 found.fit, text_of(seen.edge, seen.count), name_of(*run),
                                 expected ? "has it " + text_of(*expected, count) : "has no more"),
                     tick, seen.edge.tick, findings_.commanded(*run, tick.value_or(seen.edge.tick)));
}

void EndedProcess::differ_unrecorded(std::int64_t steps) {
    findings_.differ(fmt::format("{} after {} are not in the log; its process cannot have held so many when it ended",
                                 plural(steps, "step"), findings_.last_place()),
                     run_.newest(), findings_.last_tick(), {});
}

}  // namespace lockstep::verification
