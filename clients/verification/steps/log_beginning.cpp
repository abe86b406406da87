#include "clients/verification/steps/log_beginning.hpp"

#include <fmt/format.h>

#include <limits>

#include "core/number_text.hpp"

namespace lockstep::verification {

void LogBeginning::take(const analysis::StepBatch& batch) {
    constexpr Tick kBeginning{std::numeric_limits<std::int64_t>::min()};
    if (!steps_from_) { steps_from_ = batch.sequence > 0 ? batch.steps.front().tick : kBeginning; }
}

void LogBeginning::drop(WaitingSteps& waiting) {
    if (runs_from_) { dropped_ += waiting.drop_before(runs_from_->first, runs_from_->second); }
}

void LogBeginning::pass(ComparedRun& run) const {
    if (!is_before_log(run.run()) || !steps_from_) { return; }
    while (run->next() != nullptr && run->next()->tick < *steps_from_) { run.pass_step(false); }
}

void LogBeginning::note(AxisFindings& findings) const {
    if (dropped_ == 0) { return; }
    findings.note(fmt::format("{} before tick {} belong to runs that ended before the log began, and are not compared",
                              plural(dropped_, "step"), runs_from_->second.value));
}

}  // namespace lockstep::verification
