#include "clients/analysis/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/moves/deviation.hpp"
#include "core/axis_unit.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/enumeration.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/number_text.hpp"

namespace lockstep::analysis {
namespace {

using Findings = std::vector<Finding>;

constexpr double kOverLimit = 1.02;  // speeds are planned up to the limit and measured to within 0.1 %
constexpr Ticks kRounding{2};        // a step's error in addition to its clock's

std::string name_of(const JobLog& job) {
    return fmt::format("job {} ({})", job.job, job.name.empty() ? job.kind : job.name);
}

std::int64_t total(const Analysis& analysis, std::int64_t JobLog::*of) {
    std::int64_t sum = 0;
    for (const JobLog& job : analysis.jobs) { sum += job.*of; }
    return sum;
}

/// Missing messages of steps between others in the log. A log may begin after the machine, so earlier messages do not
/// count.
std::int64_t missing_between(const AxisLog& axis) {
    std::int64_t missing = 0;
    for (const Break& what : axis.statistics().breaks()) { missing += what.from ? what.missing_batches : 0; }
    return missing;
}

/// Whether the log lacks steps, or may lack them because a part cannot be read.
bool lacks_steps(const Analysis& analysis) {
    const auto lacks = [](const auto& axis) { return missing_steps_of(*axis) != 0 || missing_between(*axis) != 0; };
    return !analysis.damages.empty() || analysis.end.lacks_steps() || std::ranges::any_of(analysis.axes, lacks);
}

/// Whether the log has all steps and all axes, and does not end within a job.
bool has_all_steps(const Analysis& analysis) {
    if (analysis.is_verified() && (analysis.verified.difference || analysis.verified.lacks_steps)) { return false; }
    const auto is_cut = [](const JobLog& job) { return job.outcome.empty() || !job.axes_not_known.empty(); };
    return !lacks_steps(analysis) && analysis.absent_axes().empty() && std::ranges::none_of(analysis.jobs, is_cut);
}

Finding unknown(const std::string& what, const std::string& why) {
    return {Grade::Unknown, fmt::format("{} cannot be determined: {}; lockstep log merge combines the logs of all "
                                        "processes",
                                        what, why)};
}

/// Notes axes and jobs that the log lacks, and the consequences.
void check_presence(const Analysis& analysis, Findings& found) {
    const auto absent = analysis.absent_axes();
    if (!absent.empty()) {
        found.push_back(unknown("the motion of " + in_words(absent),
                                (absent.size() == 1 ? "its" : "their") + std::string(" steps are not in this log")));
    }
    for (const JobLog& job : analysis.jobs) {
        if (job.begun_us) { continue; }
        found.push_back(unknown("the commanded motion of " + name_of(job), "its beginning is not in this log"));
    }
    if (analysis.steps_of_no_job == 0 || !analysis.jobs.empty()) { return; }
    found.push_back(unknown("the commanded motion", "the coordinator's record of it is not in this log"));
}

void check_outcome(const JobLog& job, Findings& found) {
    if (job.outcome == "failed") { found.push_back({Grade::Bad, name_of(job) + " failed"}); }
    if (job.outcome == "stopped") { found.push_back({Grade::Doubtful, name_of(job) + " was stopped before its end"}); }
    if (job.outcome.empty()) { found.push_back({Grade::Doubtful, "the log ends before " + name_of(job) + " does"}); }
    if (job.unplannable) {
        found.push_back({Grade::Doubtful,
                         fmt::format("the commanded motion of {} is not known: {}", name_of(job), *job.unplannable)});
    }
}

/// The verification compares each step with its frame and its program. Its result is the grade of the steps.
void check_exactness(const Analysis& analysis, Findings& found) {
    if (!analysis.is_verified()) { return; }
    const verification::Findings& verified = analysis.verified;
    if (const auto& difference = verified.difference) {
        const std::string where = difference->commanded.empty() ? "" : " (" + difference->commanded + ")";
        found.push_back(
            {Grade::Bad, "the steps on record are not what the programs give: " + difference->text + where});
    }
    for (const std::string& line : verified.unknown) { found.push_back({Grade::Unknown, line}); }
    if (verified.more_unknown > 0) {
        found.push_back({Grade::Unknown, fmt::format("and {} more such places", verified.more_unknown)});
    }
    if (analysis.is_exact() && verified.steps > 0) {
        found.push_back({Grade::Good, "every step is where and when its frame and its program place it, to the tick: " +
                                          plural(verified.steps, "step")});
    }
}

/// Only a job that is done must have all its steps. If the record lacks steps, the number of steps made is unknown.
void check_steps(const Analysis& analysis, const JobLog& job, bool record_lacks_steps, Findings& found) {
    if (job.is_whole() || job.outcome != "done" || job.is_touched || analysis.is_exact()) { return; }
    const std::string moves = grouped(job.moves_not_whole) + " of " + plural(job.move_count, "move");
    if (!record_lacks_steps && !job.axes_not_known.empty()) {
        found.push_back(unknown(fmt::format("whether {} of {} have the commanded steps", moves, name_of(job)),
                                "not all steps of " + in_words(job.axes_not_known) + " are in this log"));
        return;
    }
    if (analysis.is_verified() && !analysis.verified.difference) {
        found.push_back(unknown(fmt::format("whether {} of {} have the commanded steps", moves, name_of(job)),
                                "the log lacks messages"));
        return;
    }
    const Grade grade = record_lacks_steps ? Grade::Doubtful : Grade::Bad;
    found.push_back({grade, fmt::format("{}: {} do not have the commanded steps, {} were not commanded", name_of(job),
                                        moves, plural(job.unasked_steps, "step"))});
}

void check_jobs(const Analysis& analysis, Findings& found) {
    const bool lacking = lacks_steps(analysis);
    std::int64_t moves = 0;
    std::int64_t whole_jobs = 0;
    for (const JobLog& job : analysis.jobs) {
        check_outcome(job, found);
        check_steps(analysis, job, lacking, found);
        if (job.move_count == 0 || !job.is_whole()) { continue; }
        ++whole_jobs;
        moves += job.move_count - job.dwells;
    }
    if (moves == 0) { return; }
    found.push_back({Grade::Good, fmt::format("each of {} in {} has exactly the commanded steps", plural(moves, "move"),
                                              plural(whole_jobs, "job"))});
}

/// The frames on record say by how much a motor accelerated. Over a window of steps a permitted jump of speed would
/// count as acceleration too.
void check_acceleration(const Analysis& analysis, const AxisLog& axis, Findings& found) {
    const MotorConfig* config = analysis.motor_config(axis.name());
    if (config == nullptr || !axis.commanded_steps_per_tick2()) { return; }
    const double ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    const double most = *axis.commanded_steps_per_tick2() * ticks_per_s * ticks_per_s / config->steps_per_mm;
    const double limit = std::max(config->max_accel_mm_s2, config->max_decel_mm_s2);
    if (most <= limit * kOverLimit) { return; }
    found.push_back({Grade::Bad, fmt::format("{}: {:.0f} {unit}/s² is above its limit of {:.0f} {unit}/s²", axis.name(),
                                             most, limit, fmt::arg("unit", analysis.unit_of(axis.name())))});
}

void check_axis(const Analysis& analysis, const AxisLog& axis, Findings& found) {
    if (const std::int64_t missing = missing_steps_of(axis); missing != 0) {
        found.push_back({Grade::Doubtful, fmt::format("{}: at least {} are not in the log; {}", axis.name(),
                                                      plural(missing, "step"), kWhereTheRestIs)});
    } else if (const std::int64_t messages = missing_between(axis); messages != 0) {
        found.push_back({Grade::Doubtful, fmt::format("{}: {} of steps are not in the log; {}", axis.name(),
                                                      plural(messages, "message"), kWhereTheRestIs)});
    }
    const MotorConfig* config = analysis.motor_config(axis.name());
    check_acceleration(analysis, axis, found);
    const double peak = axis.statistics().peak_steps_per_tick() * 1e9 / static_cast<double>(analysis.tick_ns());
    if (config == nullptr || peak <= config->max_velocity_mm_s * config->steps_per_mm * kOverLimit) { return; }
    found.push_back({Grade::Bad, fmt::format("{}: {:.2f} {unit}/s is above its limit of {:.2f} {unit}/s", axis.name(),
                                             peak / config->steps_per_mm, config->max_velocity_mm_s,
                                             fmt::arg("unit", analysis.unit_of(axis.name())))});
}

/// The axes keep limits of their own, besides those of their motors.
void check_axis_figures(const Analysis& analysis, const AxisFigures& axis, Findings& found) {
    const AxisConfig* config = analysis.axis_config(axis.name);
    if (config == nullptr) { return; }
    const double ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    const auto check = [&](double most, double limit, const char* per) {
        if (most <= limit * kOverLimit) { return; }
        found.push_back(
            {Grade::Bad, fmt::format("axis {}: {:.2f} {unit}{} is above its limit of {:.2f} {unit}{}", axis.name, most,
                                     per, limit, per, fmt::arg("unit", lockstep::unit_of(axis.name)))});
    };
    check(axis.peak_mm_per_tick * ticks_per_s, config->max_velocity_mm_s, "/s");
    check(axis.peak_mm_per_tick2 * ticks_per_s * ticks_per_s,
          std::max(config->max_accel_mm_s2, config->max_decel_mm_s2), "/s²");
}

void check_motor_skew(const Analysis& analysis, const MotorSkew& skew, Findings& found) {
    const AxisConfig& axis = analysis.config->axes.at(skew.axis);
    if (!axis.max_skew_mm || skew.largest_mm().value_or(0) <= *axis.max_skew_mm) { return; }
    if (!has_all_steps(analysis)) {
        return found.push_back(unknown("how far apart the motors of axis " + axis.name + " were",
                                       "not all of their steps are in this log"));
    }
    found.push_back({Grade::Bad, fmt::format("the motors of axis {} were {:.3f} {unit} apart, above its max_skew_mm of "
                                             "{:g} {unit}",
                                             axis.name, *skew.largest_mm(), *axis.max_skew_mm,
                                             fmt::arg("unit", lockstep::unit_of(axis.name)))});
}

void check_events(const Analysis& analysis, Findings& found) {
    const auto faults = std::ranges::count_if(analysis.happened, &Event::is_fault);
    if (faults > 0) {
        const auto& first = *std::ranges::find_if(analysis.happened, &Event::is_fault);
        found.push_back(
            {Grade::Bad, fmt::format("{}, the first of {}: {}", plural(faults, "fault"), first.axis, first.what)});
    }
    std::int64_t interruptions = 0;
    for (const JobLog& job : analysis.jobs) { interruptions += job.interruptions(); }
    if (interruptions == 0) { return; }
    found.push_back({analysis.is_exact() ? Grade::Good : Grade::Doubtful,
                     fmt::format("motion came to rest within a job and continued {}{}", plural(interruptions, "time"),
                                 analysis.is_exact() ? ", from the same place of its path" : "")});
}

/// An encoder that does not follow shows lost steps of the motor, which the record of steps cannot show.
void check_encoders(const Analysis& analysis, Findings& found) {
    for (const auto& axis : analysis.axes) {
        const PositionLog& positions = axis->positions();
        if (positions.largest_following_error() <= 1) { continue; }
        const std::int64_t corrected = positions.corrected_steps();
        found.push_back({Grade::Doubtful, fmt::format("{}: its encoder was up to {} from its count of steps{}",
                                                      axis->name(), plural(positions.largest_following_error(), "step"),
                                                      corrected == 0 ? ""
                                                                     : fmt::format("; it lost {} and made them up",
                                                                                   plural(corrected, "step")))});
    }
}

/// Only one machine is analyzed.
void check_machines(const Analysis& analysis, Findings& found) {
    constexpr std::string_view kMachine = "machine ";
    for (const auto& [name, messages] : analysis.foreign) {
        if (!name.starts_with(kMachine)) { continue; }
        found.push_back(
            {Grade::Unknown,
             fmt::format("{} is in this log too and is not analyzed here ({}); --machine {} analyzes it", name,
                         plural(static_cast<std::int64_t>(messages), "message"), name.substr(kMachine.size()))});
    }
}

void check_end(const Analysis& analysis, Findings& found) {
    const auto lines = missing_sentences(analysis.end);
    for (const std::string& line : lines) { found.push_back({Grade::Unknown, line}); }
    if (!lines.empty()) { found.push_back({Grade::Unknown, kWhereTheRestIs}); }
}

void check_record(const Analysis& analysis, Findings& found) {
    if (analysis.missing_job_events > 0) {
        found.push_back(
            {Grade::Doubtful, fmt::format("{} of jobs not in the log: the commanded motion may be incomplete",
                                          plural(analysis.missing_job_events, "event"))});
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

void check_times(const Analysis& analysis, Findings& found) {
    TickHistogram late;
    std::int64_t not_compared = 0;
    for (const JobLog& job : analysis.jobs) {
        late.add(job.late);
        if (job.is_on_a_line()) { not_compared += std::max<std::int64_t>(0, job.made_steps - job.late.total()); }
    }
    if (late.empty()) { return; }
    Ticks bound = kRounding;
    for (const auto& axis : analysis.axes) { bound = std::max(bound, kRounding + axis->statistics().clock_error()); }
    const Grade grade = late.largest() <= bound ? Grade::Good : Grade::Doubtful;
    const std::string which = not_compared > 0 ? "every step whose time is known" : "every step";
    found.push_back({grade, late.largest() == Ticks{} ? which + " is at its commanded tick"
                                                      : fmt::format("{} is within {:.0f} us of its commanded time",
                                                                    which, analysis.microseconds(late.largest()))});
    if (not_compared == 0) { return; }
    found.push_back(unknown("whether " + plural(not_compared, "step") + " were in time",
                            "the times commanded are not in this log"));
}

/// How far exact steps of an axis may be off the line between two places, in steps.
double exact_steps_off(const Analysis& analysis) {
    return (analysis.config ? coordination_of(*analysis.config) : kStreamedPath).exact_steps_off;
}

/// By how many steps the motors of an axis may be off their places, because the times of their steps are uncertain.
double steps_by_clocks(const Analysis& analysis, MotorSet motors) {
    double most = 0;
    for (const MotorIndex m : motors) {
        const auto log = std::ranges::find(analysis.axes, analysis.motors()[m].name, &AxisLog::name);
        if (log == analysis.axes.end()) { continue; }
        const AxisStatistics& statistics = (*log)->statistics();
        const auto error = static_cast<double>((kRounding + statistics.clock_error()).value);
        most = std::max(most, statistics.peak_steps_per_tick() * error);
    }
    return most;
}

/// The maximum distance from the curve that exact steps can have: of each axis what these steps of its motors move it,
/// or the tolerance within which the program lets moves be joined, and its motion within the uncertainty of its clocks.
double exact_distance_mm(const Analysis& analysis) {
    if (analysis.kinematics == nullptr) { return 0; }
    const double steps = exact_steps_off(analysis);
    double squares = 0;
    double by_clocks = 0;
    for (const AxisIndex axis : axis_indices(analysis.kinematics->axes())) {
        const double step_mm = analysis.kinematics->step_mm(axis);
        const double most_mm = std::max(steps * step_mm, analysis.tolerance_mm);
        squares += most_mm * most_mm;
        by_clocks += step_mm * steps_by_clocks(analysis, analysis.kinematics->motors_of_axes({axis}));
    }
    return std::sqrt(squares) + by_clocks;
}

void check_distance(const Analysis& analysis, Findings& found) {
    const std::int64_t unmeasured = total(analysis, &JobLog::moves_without_distance);
    if (analysis.largest_distance_mm) {
        const double exact_mm = exact_distance_mm(analysis);
        const bool is_good = *analysis.largest_distance_mm <= exact_mm;
        Deviations largest;
        for (const JobLog& job : analysis.jobs) {
            if (!analysis.config) { break; }
            add(largest,
                deviations(*analysis.config, *analysis.kinematics, job.moves, job.move_count, job.largest_distance_mm));
        }
        const std::string amount =
            largest.empty() ? fmt::format("{:.4f} mm", *analysis.largest_distance_mm) : to_text(largest);
        std::string text = fmt::format("the stepped path is at most {} from the commanded path", amount);
        if (unmeasured > 0) { text += ", where it is known"; }
        if (!is_good) { text += fmt::format("; exact steps are within {:.4f}", exact_mm); }
        found.push_back({is_good ? Grade::Good : Grade::Bad, text});
    }
    if (unmeasured == 0) { return; }
    found.push_back(unknown("the distance of " + plural(unmeasured, "move") + " from the path",
                            "steps of an axis are missing in this log, or are too late in it"));
}

/// The finding does not cover the time before the log.
void check_missing(const Analysis& analysis, Findings& found) {
    if (!has_all_steps(analysis)) { return; }
    const auto lacks = [](const auto& axis) { return axis->statistics().missing_batches() != 0; };
    const std::string since = std::ranges::any_of(analysis.axes, lacks) ? " since the log began" : "";
    if (analysis.config || analysis.axes.empty()) {
        found.push_back(
            {Grade::Good,
             (analysis.end.open.empty() ? "no step is missing" : "no step is known to be missing") + since});
        return;
    }
    std::vector<std::string> names;  // without a configuration the log does not show whether there are more axes
    for (const auto& axis : analysis.axes) { names.push_back(axis->name()); }
    found.push_back({Grade::Good, "no step of " + in_words(names) +
                                      (analysis.end.open.empty() ? " is missing" : " is known to be missing") + since});
}

}  // namespace

std::string_view name_of(Grade grade) { return pick_name({"good", "doubtful", "unknown", "bad"}, grade); }

std::vector<Finding> findings(const Analysis& analysis) {
    Findings found;
    check_presence(analysis, found);
    check_machines(analysis, found);
    check_encoders(analysis, found);
    check_events(analysis, found);
    check_exactness(analysis, found);
    check_jobs(analysis, found);
    for (const auto& axis : analysis.axes) { check_axis(analysis, *axis, found); }
    for (const AxisFigures& axis : analysis.axis_figures) { check_axis_figures(analysis, axis, found); }
    for (const MotorSkew& skew : analysis.motor_skew) { check_motor_skew(analysis, skew, found); }
    check_end(analysis, found);
    check_record(analysis, found);
    check_times(analysis, found);
    check_distance(analysis, found);
    check_missing(analysis, found);
    if (found.empty()) { found.push_back({Grade::Unknown, "the log lacks steps, so no result is known"}); }
    std::ranges::stable_sort(found, std::ranges::greater{}, &Finding::grade);
    return found;
}

Grade worst_grade(const std::vector<Finding>& findings) { return findings.front().grade; }

}  // namespace lockstep::analysis
