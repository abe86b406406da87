#include "clients/analysis/measure/position_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep::analysis {

void PositionLog::take_steps(std::optional<Tick> last) {
    farthest_.reset();
    if (origin_ && last && *last > origin_->tick) { origin_.reset(); }
}

void PositionLog::take(const RecordedPosition& sample, const StepsEnd& steps) {
    if (count_++ == 0) { first_steps_ = sample.steps; }
    following_error_ = std::max(following_error_, std::abs(sample.following_error));
    if (takes_over_encoder(sample)) { corrected_ += std::abs(last_->following_error); }
    if (last_ && zero_.differs_between(*last_, sample)) {
        origin_ = sample;
        farthest_.reset();
    }
    last_ = sample;
    if (!farthest_ || std::abs(unrecorded_at(sample, steps)) > std::abs(unrecorded_at(*farthest_, steps))) {
        farthest_ = sample;
    }
    if (!steps_per_mm_ && sample.steps != 0 && sample.mm != 0) {
        steps_per_mm_ = std::abs(static_cast<double>(sample.steps) / sample.mm);
    }
}

/// A motor that makes up lost steps takes, at rest, the place that its encoder shows. Later positions may be on its way
/// from there.
bool PositionLog::takes_over_encoder(const RecordedPosition& sample) const {
    const auto move = last_ ? zero_.move_between(*last_, sample) : std::nullopt;
    return move && move->why == ZeroMove::Why::LostSteps && sample.following_error == 0 &&
           sample.steps - last_->steps == last_->following_error;
}

/// The steps from the last recorded step to a later position.
std::int64_t PositionLog::unrecorded_at(const RecordedPosition& sample, const StepsEnd& steps) const {
    const bool is_later = !steps.tick || sample.tick >= *steps.tick;
    if (!is_later) { return 0; }
    if (origin_) { return sample.tick >= origin_->tick ? sample.steps - origin_->steps : 0; }
    return sample.steps - steps.position_steps.value_or(first_steps_);
}

std::int64_t PositionLog::unrecorded_steps(const StepsEnd& steps) const {
    const std::int64_t at_end = last_ ? unrecorded_at(*last_, steps) : 0;
    return at_end == 0 && farthest_ ? unrecorded_at(*farthest_, steps) : at_end;
}

}  // namespace lockstep::analysis
