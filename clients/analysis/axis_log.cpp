#include "clients/analysis/axis_log.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::analysis {

std::expected<void, std::string> AxisLog::write_csv(const std::filesystem::path& directory) {
    auto steps = CsvFile::create(directory / ("steps_" + name_ + ".csv"), StepCsv::kHeader);
    if (!steps) { return std::unexpected(steps.error()); }
    auto positions = CsvFile::create(directory / ("positions_" + name_ + ".csv"), kPositionsHeader);
    if (!positions) { return std::unexpected(positions.error()); }
    step_csv_ = std::make_unique<StepCsv>(std::move(*steps));
    position_csv_ = std::make_unique<CsvFile>(std::move(*positions));
    stream_.listen(*step_csv_);
    return {};
}

void AxisLog::take(StepBatch batch) {
    farthest_position_.reset();
    if (origin_ && !batch.steps.empty() && batch.steps.back().tick > origin_->tick) { origin_.reset(); }
    stream_.take(std::move(batch));
}

void AxisLog::take(const PositionSample& sample) {
    if (positions_++ == 0) { first_position_steps_ = sample.position_steps; }
    following_error_ = std::max(following_error_, std::abs(sample.following_error_steps));
    if (has_new_zero(sample)) {
        origin_ = sample;
        farthest_position_.reset();
    }
    last_position_ = sample;
    if (!farthest_position_ || std::abs(unrecorded_at(sample)) > std::abs(unrecorded_at(*farthest_position_))) {
        farthest_position_ = sample;
    }
    if (!steps_per_mm_ && sample.position_steps != 0 && sample.position_mm != 0) {
        steps_per_mm_ = std::abs(static_cast<double>(sample.position_steps) / sample.position_mm);
    }
    if (!position_csv_) { return; }
    position_csv_->cell(sample.tick.value).cell(sample.position_steps);
    position_csv_->cell(sample.position_mm).cell(sample.velocity_mm_per_s).end_line();
}

void AxisLog::take(const Run& run) {
    double largest = commanded_acceleration_.value_or(0);
    for (const Piece& piece : run.pieces) {
        largest = std::max(largest, std::abs(piece.acceleration.steps_per_tick2()));
    }
    commanded_acceleration_ = largest;
}

std::expected<void, std::string> AxisLog::finish() {
    stream_.finish();
    statistics_.finish();
    trace_.finish();
    if (!step_csv_) { return {}; }
    auto steps = step_csv_->close();
    return steps ? position_csv_->close() : steps;
}

/// Homing and a new process give positions another zero.
bool AxisLog::has_new_zero(const PositionSample& sample) const {
    if (!last_position_) { return false; }
    return sample.incarnation != last_position_->incarnation || (sample.is_homed && !last_position_->is_homed);
}

/// The steps from the last recorded step to a later position.
std::int64_t AxisLog::unrecorded_at(const PositionSample& sample) const {
    const bool is_later = !stream_.last_tick() || sample.tick >= *stream_.last_tick();
    if (!is_later) { return 0; }
    if (origin_) { return sample.tick >= origin_->tick ? sample.position_steps - origin_->position_steps : 0; }
    return sample.position_steps - stream_.position_steps().value_or(first_position_steps_);
}

std::int64_t AxisLog::unrecorded_steps() const {
    const std::int64_t at_end = last_position_ ? unrecorded_at(*last_position_) : 0;
    return at_end == 0 && farthest_position_ ? unrecorded_at(*farthest_position_) : at_end;
}

std::int64_t missing_steps_of(const AxisLog& axis) {
    return axis.statistics().missing_steps() + std::abs(axis.unrecorded_steps());
}

}  // namespace lockstep::analysis
