#include "clients/web/machine/measuring.hpp"

namespace lockstep::web {

void Measuring::begin(std::shared_ptr<const MeasurePlan> plan) {
    const std::uint64_t before = newest_ ? newest_->number : 0;
    touches_.clear();
    newest_ = Measurement{.number = before + 1, .plan = std::move(plan), .result = {}, .problem = {}};
}

void Measuring::note_begin(const MeasurePlan* measures) {
    const bool runs = newest_ && !newest_->result && !newest_->problem;
    if (runs && newest_->plan.get() != measures) { fail(ended_early("the machine runs another job")); }
}

void Measuring::note(const ProbingRun& run, const MachineSetup& machine) {
    if (run.touch()) { touches_.push_back(*run.touch()); }
    newest_->touches = touches_.size();
    if (!run.is_over()) { return; }
    if (run.problem()) { return fail(*run.problem()); }
    const ProgramStream* stream = run.next().stream.get();
    auto result = measure_result(machine, *newest_->plan, touches_, [stream](std::string_view name) {
        return stream != nullptr ? stream->global(name) : std::nullopt;
    });
    if (!result) { return fail(result.error()); }
    newest_->result = std::make_shared<const MeasureResult>(*std::move(result));
}

void Measuring::fail(const Problem& problem) { newest_->problem = problem; }

}  // namespace lockstep::web
