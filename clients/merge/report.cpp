#include "clients/merge/report.hpp"

#include "clients/analysis/report.hpp"

namespace lockstep::merge {
namespace {

void fill(const MergedInput& input, proto::MergedInput& report) {
    report.set_log(input.log.string());
    report.set_messages(input.messages);
    report.set_kept(input.kept);
    for (const analysis::Damage& damage : input.damages) { analysis::fill_unread(damage, *report.add_unread()); }
}

void fill(const MissingSteps& missing, proto::MissingStepsReport& report) {
    report.set_messages(missing.messages);
    if (missing.from_step) { report.set_from_step(*missing.from_step); }
    if (missing.from_tick) { report.set_from_tick(missing.from_tick->value); }
    if (missing.to_step) { report.set_to_step(*missing.to_step); }
    if (missing.to_tick) { report.set_to_tick(missing.to_tick->value); }
}

void fill(const MissingChanges& missing, proto::MissingChangesReport& report) {
    report.set_messages(missing.messages);
    if (missing.from_us) { report.set_from_us(*missing.from_us); }
    report.set_to_us(missing.to_us);
}

void fill(const AxisRecord& axis, proto::AxisRecordReport& report) {
    report.set_machine(axis.machine);
    report.set_axis(axis.axis);
    report.set_steps(axis.steps);
    report.set_step_messages(axis.step_messages);
    report.set_runs(axis.runs);
    report.set_missing_step_messages(axis.missing_step_messages);
    report.set_missing_runs(axis.missing_run_messages);
    report.set_missing_positions(axis.missing_positions);
    report.set_missing_figures(axis.missing_figures);
    report.set_missing_channel_messages(axis.missing_channel_messages);
    report.set_changes_lost_by_device(axis.changes_lost_by_device);
    for (const std::string& line : axis.contradictions) { report.add_contradictions(line); }
    for (const MissingSteps& missing : axis.missing_steps) { fill(missing, *report.add_missing_steps()); }
    for (const MissingChanges& missing : axis.missing_changes) { fill(missing, *report.add_missing_changes()); }
    for (const MissingRuns& missing : axis.missing_runs) {
        proto::MissingRunsReport& runs = *report.add_missing_run_numbers();
        runs.set_first(missing.numbers.from);
        runs.set_last(missing.numbers.end - 1);
    }
}

}  // namespace

proto::MergeReport to_report(const Merged& merged, const std::filesystem::path& written) {
    proto::MergeReport report;
    report.set_log(written.string());
    report.set_complete(merged.is_complete());
    report.set_messages(merged.messages);
    report.set_duplicates(merged.duplicates);
    report.set_differing(merged.differing);
    report.set_late(merged.late);
    report.set_foreign(merged.foreign);
    report.set_missing_job_events(merged.missing_job_events);
    report.set_missing_program_parts(merged.missing_program_parts);
    for (const std::string& line : analysis::missing_sentences(merged.end)) { report.add_missing_at_end(line); }
    for (const std::string& line : analysis::open_sentences(merged.end)) { report.add_not_known(line); }
    for (const std::string& axis : merged.absent_axes) { report.add_absent_axes(axis); }
    for (const auto& log : merged.chosen.left_out) { report.add_left_out(log.string()); }
    for (const MergedInput& input : merged.inputs) { fill(input, *report.add_inputs()); }
    for (const AxisRecord& axis : merged.axes) { fill(axis, *report.add_axes()); }
    return report;
}

}  // namespace lockstep::merge
