#include "clients/analysis/report.hpp"

#include <cstdlib>
#include <utility>

#include "clients/analysis/words.hpp"

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
    if (!steps_per_mm) { return; }
    const AxisStatistics& found = axis.statistics();
    const double ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    report.set_peak_velocity_mm_s(found.peak_steps_per_tick() * ticks_per_s / *steps_per_mm);
    report.set_peak_acceleration_mm_s2(found.peak_steps_per_tick2() * ticks_per_s * ticks_per_s / *steps_per_mm);
    if (!found.last()) { return; }
    report.set_position_start_mm(static_cast<double>(found.start_steps()) / *steps_per_mm);
    report.set_position_end_mm(static_cast<double>(found.last()->position_steps) / *steps_per_mm);
}

void fill(const Analysis& analysis, const AxisLog& axis, proto::AxisAnalysis& report) {
    const AxisStatistics& found = axis.statistics();
    report.set_name(axis.name());
    report.set_steps(found.steps());
    report.set_batches(axis.counts().batches);
    report.set_missing_steps(found.missing_steps() + std::abs(axis.unrecorded_steps()));
    if (found.first()) { report.set_first_tick(found.first()->tick.value); }
    if (found.last()) { report.set_last_tick(found.last()->tick.value); }
    report.set_clock_error_us(analysis.microseconds(found.clock_error()));
    fill_lengths(analysis, axis, report);
    fill_gaps(axis, report);
}

void fill(const JobLog& job, proto::JobAnalysis& report) {
    report.set_job(job.job);
    report.set_kind(job.kind);
    report.set_outcome(job.outcome);
    report.set_name(job.name);
    if (job.begun_us && job.ended_us) { report.set_real_s(static_cast<double>(*job.ended_us - *job.begun_us) * 1e-6); }
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

proto::AnalysisReport to_report(const Analysis& analysis) {
    proto::AnalysisReport report;
    report.set_log(analysis.log.string());
    report.set_machine(analysis.machine);
    if (const auto first = analysis.first_tick()) {
        report.set_duration_s(analysis.seconds(*analysis.last_tick() - *first));
    }
    for (const auto& axis : analysis.axes) { fill(analysis, *axis, *report.add_axes()); }
    for (const JobLog& job : analysis.jobs) { fill(job, *report.add_jobs()); }
    for (const PairSkew& skew : analysis.step_skew) { fill(analysis, skew, *report.add_step_skew_between_axes()); }
    if (analysis.largest_distance_mm) { report.set_largest_distance_mm(*analysis.largest_distance_mm); }
    for (std::string& note : notes(analysis)) { report.add_notes(std::move(note)); }
    return report;
}

}  // namespace lockstep::analysis
