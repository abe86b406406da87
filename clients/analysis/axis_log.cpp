#include "clients/analysis/axis_log.hpp"

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

void AxisLog::take(const PositionSample& sample) {
    ++positions_;
    last_position_ = sample;
    if (!steps_per_mm_ && sample.position_steps != 0 && sample.position_mm != 0) {
        steps_per_mm_ = std::abs(static_cast<double>(sample.position_steps) / sample.position_mm);
    }
    if (!position_csv_) { return; }
    position_csv_->cell(sample.tick.value).cell(sample.position_steps);
    position_csv_->cell(sample.position_mm).cell(sample.velocity_mm_per_s).end_line();
}

std::expected<void, std::string> AxisLog::finish() {
    stream_.finish();
    statistics_.finish();
    trace_.finish();
    if (!step_csv_) { return {}; }
    auto steps = step_csv_->close();
    return steps ? position_csv_->close() : steps;
}

std::int64_t AxisLog::unrecorded_steps() const {
    const auto recorded = stream_.position_steps();
    if (!recorded || !last_position_) { return 0; }
    const bool is_later = !stream_.last_tick() || last_position_->tick >= *stream_.last_tick();
    return is_later ? last_position_->position_steps - *recorded : 0;
}

}  // namespace lockstep::analysis
