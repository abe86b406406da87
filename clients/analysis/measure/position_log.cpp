#include "clients/analysis/measure/position_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep::analysis {

void PositionLog::take_steps(std::optional<Tick> last) {
    farthest_.reset();
    if (origin_ && last && *last > origin_->tick) { origin_.reset(); }
}

void PositionLog::take(const PositionSample& sample, const StepsEnd& steps) {
    if (count_++ == 0) { first_steps_ = sample.position_steps; }
    following_error_ = std::max(following_error_, std::abs(sample.following_error_steps));
    if (takes_over_encoder(sample)) { corrected_ += std::abs(last_->following_error_steps); }
    if (has_new_zero(sample)) {
        origin_ = sample;
        farthest_.reset();
    }
    last_ = sample;
    if (!farthest_ || std::abs(unrecorded_at(sample, steps)) > std::abs(unrecorded_at(*farthest_, steps))) {
        farthest_ = sample;
    }
    if (!steps_per_mm_ && sample.position_steps != 0 && sample.position_mm != 0) {
        steps_per_mm_ = std::abs(static_cast<double>(sample.position_steps) / sample.position_mm);
    }
}

/// Homing, a new process and a correction of lost steps give positions another zero.
bool PositionLog::has_new_zero(const PositionSample& sample) const {
    if (!last_) { return false; }
    return sample.incarnation != last_->incarnation || (sample.is_homed && !last_->is_homed) ||
           takes_over_encoder(sample);
}

/// A motor that makes up lost steps takes, at rest, the place that its encoder shows. Later positions may be on its way
/// from there.
bool PositionLog::takes_over_encoder(const PositionSample& sample) const {
    if (!last_ || !last_->is_homed || !sample.is_homed || sample.incarnation != last_->incarnation) { return false; }
    const std::int64_t moved = sample.position_steps - last_->position_steps;
    return sample.following_error_steps == 0 && moved != 0 && moved == last_->following_error_steps &&
           last_->velocity_mm_per_s == 0;
}

/// The steps from the last recorded step to a later position.
std::int64_t PositionLog::unrecorded_at(const PositionSample& sample, const StepsEnd& steps) const {
    const bool is_later = !steps.tick || sample.tick >= *steps.tick;
    if (!is_later) { return 0; }
    if (origin_) { return sample.tick >= origin_->tick ? sample.position_steps - origin_->position_steps : 0; }
    return sample.position_steps - steps.position_steps.value_or(first_steps_);
}

std::int64_t PositionLog::unrecorded_steps(const StepsEnd& steps) const {
    const std::int64_t at_end = last_ ? unrecorded_at(*last_, steps) : 0;
    return at_end == 0 && farthest_ ? unrecorded_at(*farthest_, steps) : at_end;
}

}  // namespace lockstep::analysis
