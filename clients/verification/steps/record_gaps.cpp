#include "clients/verification/steps/record_gaps.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/number_text.hpp"

namespace lockstep::verification {
namespace {

constexpr Tick kBeginning{std::numeric_limits<std::int64_t>::min()};
constexpr Tick kNever{std::numeric_limits<std::int64_t>::max() - 1};

}  // namespace

void RecordGaps::add_steps(std::int64_t incarnation, std::optional<Tick> from, std::optional<Tick> until) {
    steps_.push_back({incarnation, from.value_or(kBeginning), until.value_or(kNever)});
}

void RecordGaps::add_runs(std::int64_t incarnation, std::optional<Tick> until) {
    runs_ = {incarnation, kBeginning, until.value_or(kNever)};
}

void RecordGaps::pass(ComparedRun& run, Findings& findings) {
    while (!steps_.empty() && run.run().incarnation == steps_.front().incarnation) {
        const Gap& gap = steps_.front();
        const StepEdge* next = run->next();
        if (next == nullptr || next->tick <= gap.from) { return; }
        if (next->tick >= gap.until) {
            steps_.pop_front();
        } else if (run.is_cut_here(nullptr)) {
            return;
        } else {
            run.pass_step(false);
            ++missing_steps_;
            findings.lacks_steps = true;
        }
    }
}

void RecordGaps::drop(WaitingSteps& waiting) {
    if (!runs_) { return; }
    dropped_steps_ += waiting.drop_before(runs_->incarnation, runs_->until + Ticks{1});
    if (!waiting.empty()) { runs_.reset(); }
}

void RecordGaps::note(AxisFindings& findings) const {
    if (missing_steps_ == 0 && dropped_steps_ == 0) { return; }
    findings.add_unknown(
        fmt::format("{} of its runs are not in the log, and {} in the log are of runs that are not; all others are "
                    "compared",
                    plural(missing_steps_, "step"), plural(dropped_steps_, "step")));
}

}  // namespace lockstep::verification
