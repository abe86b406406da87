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
    positions_.take_steps(batch.steps.empty() ? std::nullopt : std::optional(batch.steps.back().tick));
    stream_.take(std::move(batch));
}

void AxisLog::take(const RecordedPosition& position) {
    positions_.take(position, {stream_.last_tick(), stream_.position_steps()});
    if (!position_csv_) { return; }
    position_csv_->cell(position.tick.value).cell(position.steps);
    position_csv_->cell(position.mm).cell(position.velocity_mm_per_s).end_line();
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

std::int64_t missing_steps_of(const AxisLog& axis) {
    return axis.statistics().missing_steps() + std::abs(axis.unrecorded_steps());
}

}  // namespace lockstep::analysis
