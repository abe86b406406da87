#include "clients/analysis/analysis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "clients/analysis/findings.hpp"
#include "clients/text/event_text.hpp"
#include "core/axis_unit.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/number_text.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::size_t kBreaksShown = 5;  // per axis
constexpr std::size_t kEventsShown = 10;
constexpr std::size_t kProgramEventsShown = 20;
constexpr std::size_t kChannelChangesShown = 20;

std::int64_t total(const Analysis& analysis, std::int64_t (*of)(const AxisLog&)) {
    std::int64_t sum = 0;
    for (const auto& axis : analysis.axes) { sum += of(*axis); }
    return sum;
}

std::int64_t steps_of(const AxisLog& axis) { return axis.counts().steps; }
std::int64_t missing_batches_before(const AxisLog& axis) { return axis.statistics().missing_batches_before(); }
std::int64_t missing_batches_of(const AxisLog& axis) {
    return axis.statistics().missing_batches() - axis.statistics().missing_batches_before();
}
std::int64_t missing_changes_of(const AxisLog& axis) { return axis.numbers().changes.missing_within(); }
std::int64_t missing_samples_of(const AxisLog& axis) {
    return axis.numbers().positions.missing_within() + axis.numbers().figures.missing_within();
}

/// Motors with steps that the log lacks.
std::vector<std::string> axes_not_known(const Analysis& analysis) {
    std::vector<std::string> names = analysis.absent_axes();
    for (const JobLog& job : analysis.jobs) {
        for (const std::string& name : job.axes_not_known) {
            if (std::ranges::find(names, name) == names.end()) { names.push_back(name); }
        }
    }
    return names;
}

std::string missing_in_short(const Analysis& analysis) {
    const std::int64_t steps = total(analysis, missing_steps_of);
    const std::int64_t batches = total(analysis, missing_batches_of);
    const std::int64_t at_end = analysis.end.missing_messages();
    if (at_end > 0) { return plural(at_end, "message") + " missing at the end"; }
    const auto names = axes_not_known(analysis);
    if (!names.empty()) { return "not all of " + in_words(names); }
    const std::int64_t changes = total(analysis, missing_changes_of);
    if (steps == 0 && batches == 0 && changes > 0) {
        return plural(changes, "change") + " of inputs and outputs missing";
    }
    const std::int64_t others = total(analysis, missing_samples_of) + analysis.missing_job_events;
    if (steps == 0 && batches == 0 && others > 0) { return plural(others, "message") + " missing, none of steps"; }
    if (steps == 0 && batches == 0 && analysis.verified.lacks_messages) { return "messages missing, none of steps"; }
    if (steps == 0 && batches == 0 && total(analysis, missing_batches_before) > 0) {
        return "nothing missing since the log began";
    }
    if (steps == 0 && batches == 0) {
        return analysis.end.is_closed() ? "nothing missing" : "nothing missing as far as is known";
    }
    if (steps == 0) { return plural(batches, "message") + " of steps missing"; }
    return "at least " + plural(steps, "step") + " missing";
}

double seconds(const Analysis& analysis) {
    const auto first = analysis.first_tick();
    return first ? analysis.seconds(*analysis.last_tick() - *first) : 0;
}

/// Converts a position, speed or acceleration to mm, or keeps steps if the steps per mm are not known.
struct Lengths {
    double per_step = 1;
    double ticks_per_s = 1;
    double position(std::int64_t steps) const { return static_cast<double>(steps) * per_step; }
    double speed(double steps_per_tick) const { return steps_per_tick * ticks_per_s * per_step; }
    double acceleration(double steps_per_tick2) const { return speed(steps_per_tick2) * ticks_per_s; }
};

std::string axis_row(const Analysis& analysis, const AxisLog& axis) {
    const auto steps_per_mm = analysis.steps_per_mm(axis);
    const Lengths in{steps_per_mm ? 1 / *steps_per_mm : 1, 1e9 / static_cast<double>(analysis.tick_ns())};
    const AxisStatistics& found = axis.statistics();
    const auto place = [&](const std::optional<StepPlace>& at) {
        return at ? fmt::format("{:.3f}", in.position(at->position_steps)) : std::string("-");
    };
    const MotorConfig* config = analysis.motor_config(axis.name());
    const auto limit = [&](double of) { return config != nullptr ? fmt::format("{:g}", of) : std::string("-"); };
    const auto commanded = axis.commanded_steps_per_tick2();
    return fmt::format("{:<10} {:>5} {:>13} {:>10} {:>10} {:>9.2f} {:>7} {:>9} {:>7} {:>9.0f} {:>8}\n", axis.name(),
                       steps_per_mm ? analysis.unit_of(axis.name()) : "steps", grouped(found.steps()),
                       found.first() ? fmt::format("{:.3f}", in.position(found.start_steps())) : "-",
                       place(found.last()), in.speed(found.peak_steps_per_tick()),
                       limit(config != nullptr ? config->max_velocity_mm_s : 0),
                       commanded ? fmt::format("{:.0f}", in.acceleration(*commanded)) : "-",
                       limit(config != nullptr ? std::max(config->max_accel_mm_s2, config->max_decel_mm_s2) : 0),
                       in.acceleration(found.peak_steps_per_tick2()), grouped(missing_steps_of(axis)));
}

std::string axis_table(const Analysis& analysis) {
    if (analysis.axes.empty()) { return "no axis has recorded anything\n"; }
    std::string text = fmt::format("{:<10} {:>5} {:>13} {:>10} {:>10} {:>9} {:>7} {:>9} {:>7} {:>9} {:>8}\n",
                                   analysis.has_motors_as_axes() ? "axis" : "motor", "unit", "steps", "start", "end",
                                   "peak /s", "limit", "most /s²", "limit", "in 10 ms", "missing");
    for (const auto& axis : analysis.axes) {
        if (!analysis.is_board(axis->name())) { text += axis_row(analysis, *axis); }
    }
    return text +
           "most /s²: of the frames on record; in 10 ms: measured from steps, with jumps of up to start_velocity in "
           "it\n";
}

std::string axis_figures_table(const Analysis& analysis) {
    if (analysis.axis_figures.empty()) { return ""; }
    std::string text = fmt::format("\n{:<10} {:>5} {:>13} {:>10} {:>10} {:>9} {:>7} {:>9} {:>7}\n", "axis", "unit", "",
                                   "start", "end", "peak /s", "limit", "most /s²", "limit");
    const double ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    for (const AxisFigures& axis : analysis.axis_figures) {
        const AxisConfig& config = *analysis.axis_config(axis.name);
        text += fmt::format("{:<10} {:>5} {:>13} {:>10.3f} {:>10.3f} {:>9.2f} {:>7g} {:>9.0f} {:>7g}\n", axis.name,
                            unit_of(axis.name), "", axis.start_mm, axis.end_mm, axis.peak_mm_per_tick * ticks_per_s,
                            config.max_velocity_mm_s, axis.peak_mm_per_tick2 * ticks_per_s * ticks_per_s,
                            std::max(config.max_accel_mm_s2, config.max_decel_mm_s2));
    }
    return text + "all of the frames on record\n";
}

std::string motor_skew_table(const Analysis& analysis) {
    if (analysis.motor_skew.empty()) { return ""; }
    std::string text = fmt::format("\n{:<27} {:>5} {:>10} {:>10} {:>10} {:>11}\n", "motors of an axis, apart by",
                                   "unit", "in homing", "in motion", "at rest", "max_skew_mm");
    const auto shown = [](const std::optional<double>& of) {
        return of ? fmt::format("{:.4f}", *of) : std::string("-");
    };
    for (const MotorSkew& skew : analysis.motor_skew) {
        const AxisConfig& axis = analysis.config->axes.at(skew.axis);
        std::string names;
        for (const MotorConfig& motor : analysis.motors()) {
            if (motor.axis == skew.axis) { names += (names.empty() ? "" : ", ") + motor.name; }
        }
        text += fmt::format("{:<27} {:>5} {:>10} {:>10} {:>10} {:>11}\n", axis.name + ": " + names, unit_of(axis.name),
                            shown(skew.in_homing_mm), shown(skew.in_motion_mm), shown(skew.at_rest_mm),
                            axis.max_skew_mm ? fmt::format("{:g}", *axis.max_skew_mm) : "-");
    }
    return text;
}

std::string job_table(const Analysis& analysis) {
    if (analysis.jobs.empty()) { return ""; }
    std::string text = fmt::format("\n{:>5}  {:<8} {:<32} {:<10} {:>10}\n", "job", "kind", "program", "outcome", "s");
    for (const JobLog& job : analysis.jobs) {
        const std::string lasted =
            job.begun_us && job.ended_us
                ? fmt::format("{:.2f}", static_cast<double>(*job.ended_us - *job.begun_us) * 1e-6)
                : "-";
        text += fmt::format("{:>5}  {:<8} {:<32} {:<10} {:>10}\n", job.job, job.kind, job.name,
                            job.outcome.empty() ? "not ended" : job.outcome, lasted);
    }
    return text;
}

/// "X 25 mm  Y 5 mm"
std::string place_text(const ProgramPlace& place) {
    std::string text;
    for (const auto& [axis, mm] : place) {
        text += fmt::format("{}{} {:.3f} {}", text.empty() ? "" : "  ", axis, mm, unit_of(axis));
    }
    return text;
}

std::string program_event_row(const Analysis& analysis, const HappenedEvent& event) {
    const std::string line = event.line ? std::to_string(*event.line) : "-";
    const std::string place = event.is_of_program ? place_text(event.place) : "switched off at the job's end";
    std::string row = fmt::format("{:>5} {:>10.3f} {:>7}  {:<36} {}", event.job, analysis.seconds_at(event.at), line,
                                  event_text(event.event), place);
    row.erase(row.find_last_not_of(' ') + 1);
    return row + "\n";
}

std::string program_event_table(const Analysis& analysis) {
    const auto& events = analysis.program_events;
    if (events.empty()) { return ""; }
    std::string text = fmt::format("\n{:>5} {:>10} {:>7}  {:<36} {}\n", "job", "at, s", "line", "event", "place");
    for (std::size_t i = 0; i < std::min(events.size(), kProgramEventsShown); ++i) {
        text += program_event_row(analysis, events[i]);
    }
    const std::uint64_t all = events.size() + analysis.program_events_not_kept;
    if (all > kProgramEventsShown) {
        text += fmt::format("and {} more events\n", grouped(static_cast<std::int64_t>(all - kProgramEventsShown)));
    }
    return text;
}

std::string channel_table(const Analysis& analysis) {
    const auto& changes = analysis.channel_changes;
    if (changes.empty()) { return ""; }
    const MachineConfig* const machine = analysis.config ? &*analysis.config : nullptr;
    std::string text = fmt::format("\n{:>10}  {:<7} {}\n", "at, s", "motor", "input or output");
    for (std::size_t i = 0; i < std::min(changes.size(), kChannelChangesShown); ++i) {
        const double at_s = analysis.seconds_at(changes[i].at);
        text += fmt::format("{:>10.3f}  {:<7} {}\n", at_s, changes[i].motor, change_text(changes[i], machine));
    }
    const std::uint64_t all = changes.size() + analysis.channel_changes_not_kept;
    if (all > kChannelChangesShown) {
        text += fmt::format("and {} more changes\n", grouped(static_cast<std::int64_t>(all - kChannelChangesShown)));
    }
    return text;
}

std::string skew_table(const Analysis& analysis) {
    if (analysis.step_skew.empty()) { return ""; }
    const char* const title = analysis.has_motors_as_axes() ? "step skew between axes, us" : "step skew of motors, us";
    std::string text =
        fmt::format("\n{:<26} {:>12} {:>9} {:>9} {:>9} {:>9}\n", title, "steps", "p50", "p99", "max", "within");
    for (const PairSkew& skew : analysis.step_skew) {
        text +=
            fmt::format("{:<26} {:>12} {:>9.1f} {:>9.1f} {:>9.1f} {:>9}\n", skew.first + " - " + skew.second,
                        grouped(skew.steps), analysis.microseconds(skew.median), analysis.microseconds(skew.p99),
                        analysis.microseconds(skew.largest), fmt::format("±{:.0f}", analysis.microseconds(skew.error)));
    }
    return text;
}

std::string findings_text(const Analysis& analysis) {
    std::string text;
    for (const Finding& finding : findings(analysis)) {
        text += fmt::format("{:<9} {}\n", name_of(finding.grade), finding.text);
    }
    return text;
}

std::string events_text(const Analysis& analysis) {
    std::string text;
    for (std::size_t i = 0; i < std::min(analysis.happened.size(), kEventsShown); ++i) {
        const Event& event = analysis.happened[i];
        text +=
            fmt::format("{} at {:.3f} s", event.axis.empty() ? "all axes" : event.axis, analysis.seconds_at(event.at));
        if (event.line) { text += fmt::format(", line {}", *event.line); }
        text += ": " + event.what + "\n";
    }
    const std::uint64_t all = analysis.happened.size() + analysis.events_not_kept;
    if (all > kEventsShown) { text += fmt::format("and {} more such events\n", all - kEventsShown); }
    return text;
}

std::string tick_text(const std::optional<Tick>& tick, const char* otherwise) {
    return tick ? "tick " + grouped(tick->value) : otherwise;
}

std::string break_sentence(const std::string& axis, const Break& what) {
    const std::string between =
        tick_text(what.from, "the log's beginning") + " and " + tick_text(what.to, "the log's end");
    const std::string moved = plural(std::abs(what.position_change), "step");
    const std::string batches = plural(what.missing_batches, "message");
    switch (what.kind) {
        case Break::Kind::Restart: return axis + ": its process restarted between " + between + "\n";
        case Break::Kind::Jump:
            if (what.missing_batches == 0) {
                return fmt::format(
                    "{}: homing, or steps whose times were lost, changed its position by {} between {}\n", axis, moved,
                    between);
            }
            break;
        case Break::Kind::Missing: break;
    }
    if (!what.from) {
        return axis + ": " + batches + " are not in the log, before " + tick_text(what.to, "its end") + "\n";
    }
    return fmt::format("{}: at least {} in {} missing between {}\n", axis, moved, batches, between);
}

std::string axis_notes(const AxisLog& axis) {
    std::string text;
    const auto& breaks = axis.statistics().breaks();
    for (std::size_t i = 0; i < std::min(breaks.size(), kBreaksShown); ++i) {
        text += break_sentence(axis.name(), breaks[i]);
    }
    const auto more = axis.statistics().break_count() - static_cast<std::int64_t>(kBreaksShown);
    if (more > 0) { text += axis.name() + ": and " + plural(more, "more such place") + "\n"; }
    if (axis.unrecorded_steps() != 0) {
        text += fmt::format("{}: the last position is {} from the last step in the log\n", axis.name(),
                            plural(std::abs(axis.unrecorded_steps()), "step"));
    }
    if (const std::int64_t positions = axis.numbers().positions.missing_within(); positions > 0) {
        text += fmt::format("{}: {} missing\n", axis.name(), plural(positions, "message") + " of positions");
    }
    if (const std::int64_t figures = axis.numbers().figures.missing_within(); figures > 0) {
        text += fmt::format("{}: {} missing\n", axis.name(), plural(figures, "message") + " of figures");
    }
    if (const std::int64_t changes = axis.numbers().changes.missing_within(); changes > 0) {
        text += fmt::format("{}: {} of inputs and outputs missing\n", axis.name(), plural(changes, "change"));
    }
    const StreamCounts& counts = axis.counts();
    const std::int64_t left_out = counts.duplicates + counts.late;
    if (left_out > 0) {
        text += fmt::format("{}: left out {} ({} repeated, {} too late)\n", axis.name(), plural(left_out, "message"),
                            counts.duplicates, counts.late);
    }
    for (const Contradiction& what : axis.statistics().contradictions()) {
        text += fmt::format("{}: {}; it is left out\n", axis.name(), sentence(what));
    }
    return text;
}

std::string log_notes(const Analysis& analysis) {
    std::string text;
    for (const auto& [channel, events] : analysis.foreign) {
        text += fmt::format("ignored: {} of {}\n", plural(static_cast<std::int64_t>(events), "event"), channel);
    }
    return text;
}

}  // namespace

std::string in_a_line(const Analysis& analysis) {
    const std::int64_t boards =
        std::ranges::count_if(analysis.axes, [&](const auto& log) { return analysis.is_board(log->name()); });
    const std::int64_t recorded = std::ssize(analysis.axes) - boards;
    std::string parts = recorded == 1 ? "1 axis" : grouped(recorded) + " axes";
    if (!analysis.has_motors_as_axes()) {
        const std::size_t axes = analysis.kinematics->axes();
        parts = fmt::format("{}, {}", axes == 1 ? "1 axis" : fmt::format("{} axes", axes), plural(recorded, "motor"));
    }
    if (boards > 0) { parts += ", " + plural(boards, "board"); }
    return fmt::format("{} · {} · {:.3g} s · {}", parts, plural(total(analysis, steps_of), "step"), seconds(analysis),
                       missing_in_short(analysis));
}

std::vector<std::string> notes(const Analysis& analysis) {
    std::string text;
    for (const auto& axis : analysis.axes) {
        const Ticks error = axis->statistics().clock_error();
        if (error == Ticks{}) { continue; }
        text += fmt::format("{}: it has its own clock; its steps are known in machine time within {:.0f} us\n",
                            axis->name(), analysis.microseconds(error));
    }
    for (const auto& axis : analysis.axes) { text += axis_notes(*axis); }
    text += events_text(analysis) + log_notes(analysis);
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

std::string summary(const Analysis& analysis) {
    std::string text =
        fmt::format("{}\nmachine {}: {}\n\n", analysis.log.string(), analysis.machine, in_a_line(analysis));
    text += findings_text(analysis) + "\n";
    text += axis_table(analysis) + axis_figures_table(analysis) + job_table(analysis) + program_event_table(analysis) +
            channel_table(analysis);
    text += motor_skew_table(analysis) + skew_table(analysis);
    auto lines = notes(analysis);
    for (std::string& line : open_sentences(analysis.end)) { lines.push_back(std::move(line)); }
    if (!lines.empty() || !analysis.damages.empty()) { text += "\n"; }
    for (const Damage& damage : analysis.damages) { text += damage_sentence(damage) + "\n"; }
    for (const std::string& line : lines) { text += line + "\n"; }
    return text;
}

}  // namespace lockstep::analysis
