#include "core/coordinator/jobs/inherited_job.hpp"

namespace lockstep {

std::optional<TakeoverDoubt> InheritedJob::doubt(const CoordinatorLoop& loop) const {
    if (on_takeover_ != OnTakeover::Continue) { return TakeoverDoubt::NotAsked; }
    if (!last_->program) { return TakeoverDoubt::NotRunning; }
    const bool is_late = interrupted_ && *interrupted_ + rules::kHopSlots >= last_->stamp;
    if (is_late) { return TakeoverDoubt::Interrupted; }
    if (!loop.programs.find(*last_->program)) { return TakeoverDoubt::UnknownProgram; }
    if (last_->config_hash != config_hash_) { return TakeoverDoubt::OtherPlan; }
    return loop.axes.missing(loop.slot) ? std::optional(TakeoverDoubt::AxisInDoubt) : std::nullopt;
}

std::expected<JobRest, TakeoverDoubt> InheritedJob::rest(const KnownProgram& program,
                                                         const CoordinatorLoop& loop) const {
    return rest_of_job(*last_, program, loop.machine, loop.axes.views());
}

}  // namespace lockstep
