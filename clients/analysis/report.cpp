#include "clients/analysis/report.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/findings.hpp"
#include "clients/analysis/moves/deviation.hpp"
#include "clients/analysis/record_state.hpp"
#include "clients/text/event_text.hpp"
#include "core/axis_unit.hpp"
#include "core/kinematics/kinematics.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::analysis {
namespace {

void fill_gaps(const AxisLog& axis, proto::AxisAnalysis& report) {
    for (const Break& what : axis.statistics().breaks()) {
        if (what.missing_batches == 0 || !what.from) { continue; }
        proto::Gap& gap = *report.add_gaps();
        gap.set_after_tick(what.from->value);
        gap.set_before_tick(what.to.value_or(*what.from).value);
        gap.set_missing_steps(std::abs(what.position_change));
    }
}

void fill_lengths(const Analysis& analysis, const AxisLog& axis, proto::AxisAnalysis& report) {
    const auto steps_per_mm = analysis.steps_per_mm(axis);
    if (!steps_per_mm || analysis.is_board(axis.name())) { return; }
    const AxisStatistics& found = axis.statistics();
    const double ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    report.set_peak_velocity_mm_s(found.peak_steps_per_tick() * ticks_per_s / *steps_per_mm);
    report.set_peak_acceleration_mm_s2(found.peak_steps_per_tick2() * ticks_per_s * ticks_per_s / *steps_per_mm);
    if (!found.last()) { return; }
    report.set_position_start_mm(static_cast<double>(found.start_steps()) / *steps_per_mm);
    report.set_position_end_mm(static_cast<double>(found.last()->position_steps) / *steps_per_mm);
}

void fill(const Analysis& analysis, const TickHistogram& late, proto::StepTimeError& report) {
    report.set_steps(late.total());
    report.set_p50_us(analysis.microseconds(late.quantile(50)));
    report.set_p99_us(analysis.microseconds(late.quantile(99)));
    report.set_max_us(analysis.microseconds(late.largest()));
}

void fill(const Analysis& analysis, const AxisLog& axis, proto::AxisAnalysis& report) {
    const AxisStatistics& found = axis.statistics();
    report.set_name(axis.name());
    if (analysis.steps_per_mm(axis)) { report.set_unit(std::string(analysis.unit_of(axis.name()))); }
    const MotorConfig* config = analysis.motor_config(axis.name());
    if (config != nullptr && config->axis && !analysis.has_motors_as_axes()) {
        report.set_axis(analysis.config->axes[*config->axis].name);
    }
    if (analysis.is_board(axis.name())) { report.set_board(true); }
    report.set_steps(found.steps());
    report.set_batches(axis.counts().batches);
    report.set_missing_steps(found.missing_steps() + std::abs(axis.unrecorded_steps()));
    report.set_missing_positions(axis.numbers().positions.missing_within());
    report.set_missing_figures(axis.numbers().figures.missing_within());
    report.set_missing_changes(axis.numbers().changes.missing_within());
    if (found.first()) { report.set_first_tick(found.first()->tick.value); }
    if (found.last()) { report.set_last_tick(found.last()->tick.value); }
    report.set_clock_error_us(analysis.microseconds(found.clock_error()));
    fill(analysis, axis.late(), *report.mutable_step_time_error());
    fill_lengths(analysis, axis, report);
    fill_gaps(axis, report);
}

void fill(const Analysis& analysis, const MotorConfig& config, const MotorMove& move, proto::AxisMoveAnalysis& report) {
    const double per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    report.set_name(config.name);
    report.set_asked_steps(move.asked_steps);
    report.set_made_steps(move.made_steps);
    if (move.peak_steps_per_tick > 0) {
        report.set_peak_velocity_mm_s(move.peak_steps_per_tick * per_s / config.steps_per_mm);
    }
    if (move.peak_steps_per_tick2 > 0) {
        report.set_peak_acceleration_mm_s2(move.peak_steps_per_tick2 * per_s * per_s / config.steps_per_mm);
    }
}

using Names = google::protobuf::RepeatedPtrField<std::string>;

/// `not_known`: motors whose steps the log lacks.
void fill(const Analysis& analysis, const MoveLog& move, const Names& not_known, proto::MoveAnalysis& report) {
    report.set_line(move.line);
    if (analysis.config) {
        report.set_unit(std::string(name_of(motion_unit(*analysis.config, *analysis.kinematics, move))));
    }
    report.set_dwell(is_dwell(move));
    report.set_length_mm(move.length_mm);
    report.set_planned_s(analysis.seconds(move.planned));
    if (move.made) { report.set_real_s(analysis.seconds(*move.made)); }
    if (move.first) { report.set_begun_s(analysis.seconds_at(*move.first)); }
    if (move.largest_distance_mm) { report.set_largest_distance_mm(*move.largest_distance_mm); }
    report.set_skew_max_us(analysis.microseconds(move.skew));
    fill(analysis, move.late, *report.mutable_step_time_error());
    for (std::size_t i = 0; i < std::min(move.motors.size(), analysis.motors().size()); ++i) {
        const MotorMove& made = move.motors[i];
        if (made.asked_steps == 0 && made.made_steps == 0) { continue; }
        const MotorConfig& motor = analysis.motors()[i];
        fill(analysis, motor, made, *report.add_axes());
        const bool is_short = made.made_steps < made.asked_steps;
        const bool is_known = std::ranges::find(not_known, motor.name) == not_known.end();
        report.mutable_axes()->rbegin()->set_made_unknown(is_short && !is_known);
    }
}

/// What only a machine with a known configuration has.
void fill_axes(const Analysis& analysis, const JobLog& job, proto::JobAnalysis& report) {
    if (!analysis.config) { return; }
    for (const auto& [unit, largest] :
         deviations(*analysis.config, *analysis.kinematics, job.moves, job.move_count, job.largest_distance_mm)) {
        proto::Deviation& out = *report.add_deviations();
        out.set_unit(std::string(name_of(unit)));
        out.set_largest(largest);
    }
    for (const MotorConfig& motor : analysis.motors()) {
        if (!has_all_steps_of(analysis, job, motor.name)) { report.add_axes_not_known(motor.name); }
    }
}

void fill_steps(const Analysis& analysis, const JobLog& job, proto::JobAnalysis& report) {
    report.set_move_count(job.move_count);
    report.set_dwells(job.dwells);
    report.set_asked_steps(job.asked_steps);
    report.set_made_steps(job.made_steps);
    report.set_unasked_steps(job.unasked_steps);
    report.set_moves_not_whole(job.moves_not_whole);
    report.set_interruptions(job.interruptions());
    if (job.largest_distance_mm) { report.set_largest_distance_mm(*job.largest_distance_mm); }
    fill(analysis, job.late, *report.mutable_step_time_error());
    fill_axes(analysis, job, report);
    for (const MoveLog& move : job.moves) { fill(analysis, move, report.axes_not_known(), *report.add_moves()); }
}

void fill(const Analysis& analysis, const JobLog& job, proto::JobAnalysis& report) {
    report.set_job(job.job);
    report.set_kind(job.kind);
    report.set_outcome(job.outcome);
    report.set_name(job.name);
    if (job.planned) { report.set_planned_s(analysis.seconds(*job.planned)); }
    report.set_overridden(job.overridden);
    if (job.begun_us) { report.set_begun_s(analysis.seconds_at(analysis.tick_at(*job.begun_us))); }
    if (job.begun_us && job.ended_us) { report.set_real_s(static_cast<double>(*job.ended_us - *job.begun_us) * 1e-6); }
    fill_steps(analysis, job, report);
}

void fill(const Analysis& analysis, const Event& event, proto::LogEvent& report) {
    report.set_tick(event.at.value);
    report.set_at_s(analysis.seconds_at(event.at));
    report.set_what(event.what);
    if (!event.axis.empty()) { report.set_axis(event.axis); }
    if (!event.remedy.empty()) { report.set_remedy(event.remedy); }
    if (event.job) { report.set_job(*event.job); }
    if (event.line) { report.set_line(*event.line); }
    for (const auto& [axis, steps] : event.at_steps) {
        proto::FinalPosition& position = *report.add_positions();
        position.set_name(axis);
        position.set_position_steps(steps);
        const MotorConfig* config = analysis.motor_config(axis);
        if (config != nullptr) { position.set_position_mm(to_mm(*config, static_cast<double>(steps))); }
    }
}

/// Adds steps only if the machine's configuration is known.
void fill(const Analysis& analysis, const ProgramPlace& place,
          google::protobuf::RepeatedPtrField<proto::FinalPosition>& out) {
    for (const auto& [axis, mm] : place) {
        proto::FinalPosition& position = *out.Add();
        position.set_name(axis);
        position.set_position_mm(mm);
        if (const AxisConfig* config = analysis.axis_config(axis)) {
            position.set_position_steps(to_steps(*config, mm));
        }
    }
}

void fill(const Analysis& analysis, const ChannelChange& change, proto::ChannelChangeReport& report) {
    report.set_tick(change.at.value);
    report.set_at_s(analysis.seconds_at(change.at));
    report.set_motor(change.motor);
    report.set_kind(std::string(name_of(change.kind)));
    report.set_channel(static_cast<std::uint32_t>(change.channel));
    report.set_value(change.value);
    const auto name = analysis.config ? name_of(change, *analysis.config) : std::nullopt;
    if (name) { report.set_name(*name); }
}

void fill(const Analysis& analysis, const HappenedEvent& event, proto::ProgramEventReport& report) {
    report.set_tick(event.at.value);
    report.set_at_s(analysis.seconds_at(event.at));
    report.set_what(event_text(event.event));
    report.set_kind(std::string(name_of(event.event.kind)));
    report.set_index(event.event.index);
    report.set_value(event.event.value);
    report.set_job(event.job);
    if (event.line) { report.set_line(*event.line); }
    report.set_at_rest(event.at_rest);
    report.set_of_program(event.is_of_program);
    fill(analysis, event.place, *report.mutable_place());
}

void fill_findings(const Analysis& analysis, proto::AnalysisReport& report) {
    const auto found = findings(analysis);
    report.set_verdict(std::string(name_of(worst_grade(found))));
    for (const Finding& finding : found) {
        proto::Finding& out = *report.add_findings();
        out.set_grade(std::string(name_of(finding.grade)));
        out.set_text(finding.text);
    }
}

void fill(const Analysis& analysis, const AxisFigures& axis, proto::AxisMotion& report) {
    const double ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    report.set_name(axis.name);
    report.set_unit(std::string(unit_of(axis.name)));
    report.set_position_start_mm(axis.start_mm);
    report.set_position_end_mm(axis.end_mm);
    report.set_peak_velocity_mm_s(axis.peak_mm_per_tick * ticks_per_s);
    report.set_peak_acceleration_mm_s2(axis.peak_mm_per_tick2 * ticks_per_s * ticks_per_s);
    const AxisConfig* config = analysis.axis_config(axis.name);
    if (config == nullptr) { return; }
    report.set_max_velocity_mm_s(config->max_velocity_mm_s);
    report.set_max_acceleration_mm_s2(std::max(config->max_accel_mm_s2, config->max_decel_mm_s2));
}

void fill(const Analysis& analysis, const MotorSkew& skew, proto::MotorSkewReport& report) {
    const AxisConfig& axis = analysis.config->axes.at(skew.axis);
    report.set_axis(axis.name);
    report.set_unit(std::string(unit_of(axis.name)));
    if (skew.in_homing_mm) { report.set_in_homing_mm(*skew.in_homing_mm); }
    if (skew.in_motion_mm) { report.set_in_motion_mm(*skew.in_motion_mm); }
    if (skew.at_rest_mm) { report.set_at_rest_mm(*skew.at_rest_mm); }
    if (axis.max_skew_mm) { report.set_max_skew_mm(*axis.max_skew_mm); }
}

void fill(const Analysis& analysis, const PairSkew& skew, proto::StepSkew& report) {
    report.set_first(skew.first);
    report.set_second(skew.second);
    report.set_steps(skew.steps);
    report.set_p50_us(analysis.microseconds(skew.median));
    report.set_p99_us(analysis.microseconds(skew.p99));
    report.set_max_us(analysis.microseconds(skew.largest));
    report.set_error_us(analysis.microseconds(skew.error));
}

}  // namespace

void fill_unread(const Damage& damage, proto::UnreadStretch& report) {
    report.set_first_byte(damage.first_byte);
    report.set_last_byte(damage.last_byte);
    report.set_places(damage.places);
    report.set_bytes(damage.bytes);
    report.set_reason(damage.what);
}

void fill(const PowerMap& map, proto::PowerReport& report) {
    const PowerSums asked = map.asked.all();
    const PowerSums made = map.made.all();
    report.set_output(map.output);
    report.set_asked_energy_s(asked.energy_s);
    report.set_made_energy_s(made.energy_s);
    report.set_asked_mm(asked.burned_mm);
    report.set_made_mm(made.burned_mm);
    report.set_unknown_mm(map.unknown_mm);
    report.set_most_energy_ms_per_mm(1e3 * map.most_energy);
    if (map.largest_energy_difference) {
        report.set_largest_energy_difference_percent(100 * *map.largest_energy_difference);
    }
    report.set_changes_compared(map.changes_compared);
    report.set_largest_place_mm(map.largest_place_mm);
    report.set_cell_mm(map.asked.cell_mm());
}

proto::AnalysisReport to_report(const Analysis& analysis) {
    proto::AnalysisReport report;
    report.set_log(analysis.log.string());
    report.set_machine(analysis.machine);
    if (const auto first = analysis.first_tick()) {
        report.set_duration_s(analysis.seconds(*analysis.last_tick() - *first));
    }
    for (const auto& axis : analysis.axes) { fill(analysis, *axis, *report.add_axes()); }
    for (const AxisFigures& axis : analysis.axis_figures) { fill(analysis, axis, *report.add_axis_motion()); }
    for (const MotorSkew& skew : analysis.motor_skew) { fill(analysis, skew, *report.add_motor_skew()); }
    for (const JobLog& job : analysis.jobs) { fill(analysis, job, *report.add_jobs()); }
    for (const PairSkew& skew : analysis.step_skew) { fill(analysis, skew, *report.add_step_skew_between_axes()); }
    if (analysis.largest_distance_mm) { report.set_largest_distance_mm(*analysis.largest_distance_mm); }
    fill_findings(analysis, report);
    report.set_jobs_not_listed(analysis.jobs_not_kept);
    report.set_missing_job_events(analysis.missing_job_events);
    for (const std::string& line : missing_sentences(analysis.end)) { report.add_missing_at_end(line); }
    for (const std::string& line : open_sentences(analysis.end)) { report.add_not_known(line); }
    for (const Event& event : analysis.happened) { fill(analysis, event, *report.add_events()); }
    for (const HappenedEvent& event : analysis.program_events) { fill(analysis, event, *report.add_program_events()); }
    report.set_program_events_not_listed(analysis.program_events_not_kept);
    for (const ChannelChange& change : analysis.channel_changes) {
        fill(analysis, change, *report.add_channel_changes());
    }
    report.set_channel_changes_not_listed(analysis.channel_changes_not_kept);
    for (const PowerMap& map : analysis.power_maps) { fill(map, *report.add_power()); }
    for (const Damage& damage : analysis.damages) { fill_unread(damage, *report.add_unread()); }
    for (std::string& note : notes(analysis)) { report.add_notes(std::move(note)); }
    return report;
}

}  // namespace lockstep::analysis
