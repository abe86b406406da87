#include "clients/analysis/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "clients/analysis/figures.hpp"
#include "clients/analysis/judged_log.hpp"
#include "clients/analysis/measure/late_meter.hpp"
#include "clients/analysis/plane_path.hpp"
#include "clients/analysis/recorder.hpp"
#include "clients/analysis/sorter.hpp"
#include "clients/analysis/stages/stage_thread.hpp"
#include "core/axis_unit.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep::analysis {
namespace {

std::expected<void, std::string> make_directory(const std::optional<std::filesystem::path>& directory) {
    if (!directory) { return {}; }
    std::error_code error;
    std::filesystem::create_directories(*directory, error);
    if (error) { return std::unexpected(directory->string() + ": cannot be created: " + error.message()); }
    return {};
}

/// Why the content could not be read.
std::string first_reason(const Analysis& analysis) {
    if (analysis.damages.empty()) { return ""; }
    const Damage& first = analysis.damages.front();
    return fmt::format(", or not in a readable form: {}, at byte {}", first.what, first.first_byte);
}

std::string of_machine(const std::optional<std::string>& machine) { return machine ? " of machine " + *machine : ""; }

}  // namespace

bool is_dwell(const MoveLog& move) {
    return move.length_mm == 0 &&
           std::ranges::none_of(move.motors, [](const MotorMove& motor) { return motor.asked_steps != 0; });
}

std::span<const MotorConfig> Analysis::motors() const {
    return kinematics != nullptr ? std::span(kinematics->motors()) : std::span<const MotorConfig>();
}

const MotorConfig* Analysis::motor_config(const std::string& name) const {
    const auto found = std::ranges::find(motors(), name, &MotorConfig::name);
    return found == motors().end() ? nullptr : &*found;
}

bool Analysis::is_board(const std::string& name) const {
    const MotorConfig* const configured = motor_config(name);
    return configured != nullptr && configured->is_board();
}

const AxisConfig* Analysis::axis_config(const std::string& name) const {
    if (!config) { return nullptr; }
    const auto found = std::ranges::find(config->axes, name, &AxisConfig::name);
    return found == config->axes.end() ? nullptr : &*found;
}

std::string Analysis::label_of(const std::string& motor) const {
    const MotorConfig* configured = motor_config(motor);
    if (configured == nullptr) { return "axis " + motor; }
    return kinematics->label(MotorIndex{static_cast<std::size_t>(configured - motors().data())});
}

std::string_view Analysis::unit_of(const std::string& motor) const {
    const MotorConfig* configured = motor_config(motor);
    return lockstep::unit_of(configured && configured->axis ? config->axes[*configured->axis].name : motor);
}

std::optional<double> Analysis::steps_per_mm(const AxisLog& axis) const {
    const MotorConfig* configured = motor_config(axis.name());
    return configured ? std::optional(configured->steps_per_mm) : axis.positions().steps_per_mm();
}

std::vector<std::string> Analysis::absent_axes() const {
    std::vector<std::string> absent;
    for (const MotorConfig& axis : motors()) {
        const auto is_it = [&](const auto& recorded) { return recorded->name() == axis.name; };
        if (std::ranges::none_of(axes, is_it)) { absent.push_back(axis.name); }
    }
    return absent;
}

std::optional<Tick> Analysis::first_tick() const {
    std::optional<Tick> first;
    for (const auto& axis : axes) {
        const auto& place = axis->statistics().first();
        if (place && (!first || place->tick < *first)) { first = place->tick; }
    }
    return first;
}

std::optional<Tick> Analysis::last_tick() const {
    std::optional<Tick> last;
    for (const auto& axis : axes) {
        const auto& place = axis->statistics().last();
        if (place && (!last || place->tick > *last)) { last = place->tick; }
    }
    return last;
}

std::expected<Analysis, std::string> analyze_log(const std::filesystem::path& log, const AnalysisOptions& options) {
    for (const auto& directory : {options.csv_dir, options.svg_dir}) {
        if (auto made = make_directory(directory); !made) { return std::unexpected(made.error()); }
    }
    Recorder recorder(options);
    StageThread recording(recorder);
    LateMeter late(recording);
    StageThread comparing(late);
    Sorter sorter(options, comparing);
    JudgedLog judged(sorter);
    const auto events = read_log(log, judged, options.progress);
    if (!events) { return std::unexpected(events.error()); }
    const auto written = sorter.finish();
    if (!written) { return std::unexpected(written.error()); }
    comparing.finish();
    auto skew = late.finish();
    recording.finish();
    Analysis analysis = recorder.finish(sorter);
    analysis.step_skew = std::move(skew);
    analysis.verified = judged.finish();
    if (analysis.axes.empty() && analysis.jobs.empty()) {
        return std::unexpected(log.string() + ": it contains no record of Lockstep" + of_machine(options.machine) +
                               first_reason(analysis));
    }
    analysis.log = log;
    analysis.events = *events;
    if (!options.svg_dir) { return analysis; }
    if (auto drawn = write_figures(analysis, paths_in_plane(analysis), *options.svg_dir); !drawn) {
        return std::unexpected(drawn.error());
    }
    return analysis;
}

}  // namespace lockstep::analysis
