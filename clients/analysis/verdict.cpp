#include "clients/analysis/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "clients/analysis/numbers.hpp"
#include "clients/analysis/words.hpp"

namespace lockstep::analysis {
namespace {

using Findings = std::vector<Finding>;

constexpr double kOverLimit = 1.02;  // a speed is measured to within 0.1 %, and planned up to the limit
constexpr Ticks kRounding{2};        // what a step may be off besides its clock

std::string name_of(const JobLog& job) {
    return fmt::format("job {} ({})", job.job, job.name.empty() ? job.kind : job.name);
}

/// Or may lack them, where something cannot be read.
bool lacks_steps(const Analysis& analysis) {
    return !analysis.damages.empty() ||
           std::ranges::any_of(analysis.axes, [](const auto& axis) { return missing_steps_of(*axis) != 0; });
}

void judge_outcome(const JobLog& job, Findings& found) {
    if (job.outcome == "failed") { found.push_back({Grade::Bad, name_of(job) + " failed"}); }
    if (job.outcome == "stopped") { found.push_back({Grade::Doubtful, name_of(job) + " was stopped before its end"}); }
    if (job.outcome.empty()) { found.push_back({Grade::Doubtful, "the log ends before " + name_of(job) + " does"}); }
    if (job.unplannable) {
        found.push_back({Grade::Doubtful, "what " + name_of(job) + " asked for is not known: " + *job.unplannable});
    }
}

/// Of a job that was not done, the rest is not missed. Where the record lacks steps, nobody knows what was made.
void judge_steps(const JobLog& job, bool record_lacks_steps, Findings& found) {
    if (job.is_whole() || job.outcome != "done") { return; }
    const Grade grade = record_lacks_steps ? Grade::Doubtful : Grade::Bad;
    found.push_back({grade, fmt::format("{}: {} of {} do not have the steps asked, {} were not asked for", name_of(job),
                                        grouped(job.moves_not_whole), plural(job.move_count, "move"),
                                        plural(job.unasked_steps, "step"))});
}

void judge_jobs(const Analysis& analysis, Findings& found) {
    const bool lacking = lacks_steps(analysis);
    std::int64_t moves = 0;
    std::int64_t whole_jobs = 0;
    for (const JobLog& job : analysis.jobs) {
        judge_outcome(job, found);
        judge_steps(job, lacking, found);
        if (job.move_count == 0 || !job.is_whole()) { continue; }
        ++whole_jobs;
        moves += job.move_count;
    }
    if (moves == 0) { return; }
    found.push_back({Grade::Good, fmt::format("each of {} in {} has exactly the steps asked", plural(moves, "move"),
                                              plural(whole_jobs, "job"))});
}

void judge_axis(const Analysis& analysis, const AxisLog& axis, Findings& found) {
    if (const std::int64_t missing = missing_steps_of(axis); missing != 0) {
        found.push_back({Grade::Doubtful, fmt::format("{}: at least {} are not in the log; {}", axis.name(),
                                                      plural(missing, "step"), kWhereTheRestIs)});
    }
    const AxisConfig* config = analysis.axis_config(axis.name());
    const double peak = axis.statistics().peak_steps_per_tick() * 1e9 / static_cast<double>(analysis.tick_ns());
    if (config == nullptr || peak <= config->max_velocity_mm_s * config->steps_per_mm * kOverLimit) { return; }
    found.push_back({Grade::Bad, fmt::format("{}: {:.2f} mm/s is above its limit of {:.2f} mm/s", axis.name(),
                                             peak / config->steps_per_mm, config->max_velocity_mm_s)});
}

void judge_events(const Analysis& analysis, Findings& found) {
    const auto faults = std::ranges::count_if(analysis.happened, &Event::is_fault);
    if (faults > 0) {
        const auto& first = *std::ranges::find_if(analysis.happened, &Event::is_fault);
        found.push_back(
            {Grade::Bad, fmt::format("{}, the first of {}: {}", plural(faults, "fault"), first.axis, first.what)});
    }
    std::int64_t interruptions = 0;
    for (const JobLog& job : analysis.jobs) { interruptions += job.interruptions(); }
    if (interruptions > 0) {
        found.push_back({Grade::Doubtful, "motion was interrupted and went on " + plural(interruptions, "time")});
    }
}

void judge_record(const Analysis& analysis, Findings& found) {
    if (analysis.missing_job_events > 0) {
        found.push_back({Grade::Doubtful, fmt::format("{} of jobs not in the log: what was asked may not all be known",
                                                      plural(analysis.missing_job_events, "event"))});
    }
    std::int64_t untold = 0;
    for (const JobLog& job : analysis.jobs) { untold += job.moves_without_distance; }
    if (untold > 0) {
        found.push_back(
            {Grade::Doubtful, fmt::format("how far {} went from the path is not known: steps of an axis come "
                                          "too late in the log; `lockstep log merge` puts them in order",
                                          plural(untold, "move"))});
    }
    std::uint64_t places = 0;
    std::uint64_t bytes = 0;
    for (const Damage& damage : analysis.damages) {
        places += damage.places;
        bytes += damage.bytes;
    }
    if (places == 0) { return; }
    found.push_back({Grade::Doubtful,
                     fmt::format("{} of the log in {} cannot be read", plural(static_cast<std::int64_t>(bytes), "byte"),
                                 plural(static_cast<std::int64_t>(places), "place"))});
}

void judge_times(const Analysis& analysis, Findings& found) {
    TickHistogram late;
    for (const JobLog& job : analysis.jobs) { late.add(job.late); }
    if (late.empty()) { return; }
    Ticks bound = kRounding;
    for (const auto& axis : analysis.axes) { bound = std::max(bound, kRounding + axis->statistics().clock_error()); }
    const Grade grade = late.largest() <= bound ? Grade::Good : Grade::Doubtful;
    found.push_back({grade, fmt::format("no step is more than {:.0f} us from the time commanded",
                                        analysis.microseconds(late.largest()))});
}

}  // namespace

std::string_view name_of(Grade grade) {
    constexpr std::array<std::string_view, 3> kNames{"good", "doubtful", "bad"};
    return kNames[static_cast<std::size_t>(grade)];
}

std::vector<Finding> findings(const Analysis& analysis) {
    Findings found;
    judge_events(analysis, found);
    judge_jobs(analysis, found);
    for (const auto& axis : analysis.axes) { judge_axis(analysis, *axis, found); }
    judge_record(analysis, found);
    judge_times(analysis, found);
    if (analysis.largest_distance_mm) {
        found.push_back({Grade::Good, fmt::format("the path stepped is at most {:.4f} mm from the path asked",
                                                  *analysis.largest_distance_mm)});
    }
    if (!lacks_steps(analysis)) { found.push_back({Grade::Good, "no step is missing"}); }
    std::ranges::stable_sort(found, std::ranges::greater{}, &Finding::grade);
    return found;
}

Grade verdict(const std::vector<Finding>& findings) { return findings.front().grade; }

std::string headline(const std::vector<Finding>& findings) {
    return std::string(name_of(verdict(findings))) + ": " + findings.front().text;
}

}  // namespace lockstep::analysis
