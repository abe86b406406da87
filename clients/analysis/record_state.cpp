#include "clients/analysis/record_state.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/number_text.hpp"

namespace lockstep::analysis {
namespace {

struct TimeSpan {
    Tick begin;
    Tick end;
};

/// The time of a job. The record's order of events and steps allows an uncertainty at both ends.
TimeSpan time_of(const Analysis& analysis, const JobLog& job) {
    constexpr std::int64_t kMargin_us = 100'000;
    const std::int64_t begun = job.begun_us.value_or(0);
    return {analysis.tick_at(begun - kMargin_us), analysis.tick_at(job.ended_us.value_or(begun) + kMargin_us)};
}

bool is_within(const Break& gap, TimeSpan time) {
    const bool ends_before = gap.to && *gap.to < time.begin;
    const bool begins_behind = gap.from && *gap.from > time.end;
    return gap.missing_batches > 0 && !ends_before && !begins_behind;
}

bool has_gap(const AxisStatistics& axis, TimeSpan time) {
    const bool are_all_kept = axis.break_count() == std::ssize(axis.breaks());
    return !are_all_kept || std::ranges::any_of(axis.breaks(), [&](const Break& gap) { return is_within(gap, time); });
}

/// Whether the log lacks steps after the axis's last one, and these may be of the job.
bool ends_within(const Analysis& analysis, const AxisLog& axis, TimeSpan time) {
    const auto lacks_its_end = [&](const MissingEnd& missing) {
        return missing.kind == RecordKind::Steps && missing.process.axis == axis.name() &&
               missing.published_us >= analysis.microseconds_at(time.begin);
    };
    const auto& last = axis.statistics().last();
    const bool stops_short = axis.unrecorded_steps() != 0 && (!last || last->tick < time.end);
    return stops_short || std::ranges::any_of(analysis.end.missing, lacks_its_end);
}

}  // namespace

std::string missing_between(const std::string& process, std::int64_t messages, const std::string& what) {
    return fmt::format("{}: {} of {}", process, plural(messages, "message"), what);
}

RecordState record_state(const Analysis& analysis) {
    RecordState state{.missing = missing_sentences(analysis.end), .not_known = open_sentences(analysis.end)};
    const auto note = [&](const std::string& process, std::int64_t messages, const char* what) {
        if (messages > 0) { state.missing.push_back(missing_between(process, messages, what)); }
    };
    for (const auto& axis : analysis.axes) {
        const std::string process = analysis.label_of(axis->name());
        note(process, axis->statistics().missing_batches(), "steps");
        note(process, axis->numbers().positions.missing_within(), "positions");
        note(process, axis->numbers().figures.missing_within(), "figures");
        note(process, axis->numbers().changes.missing_within(), kChannelChanges);
    }
    note("coordinator", analysis.missing_job_events, "jobs");
    return state;
}

std::string to_text(const RecordState& state) {
    if (!state.is_complete()) { return fmt::format("missing: {}", fmt::join(state.missing, "; ")); }
    if (state.not_known.empty()) { return "complete: no message of the record is missing"; }
    return fmt::format("complete as far as is known: {}", fmt::join(state.not_known, "; "));
}

bool has_all_steps_of(const Analysis& analysis, const JobLog& job, const std::string& axis) {
    const auto log = std::ranges::find(analysis.axes, axis, [](const auto& each) { return each->name(); });
    const bool is_cut = !job.begun_us || !job.ended_us || !analysis.damages.empty();
    const bool is_lost = std::ranges::find(job.axes_not_known, axis) != job.axes_not_known.end();
    if (log == analysis.axes.end() || is_cut || is_lost) { return false; }
    const TimeSpan time = time_of(analysis, job);
    return !has_gap((*log)->statistics(), time) && !ends_within(analysis, **log, time);
}

}  // namespace lockstep::analysis
