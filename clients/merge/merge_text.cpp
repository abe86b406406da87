#include <fmt/format.h>

#include "clients/merge/report.hpp"
#include "core/number_text.hpp"

namespace lockstep::merge {
namespace {

constexpr std::size_t kLinesOfAnAxis = 10;  // --json has more

std::string place(const std::optional<std::int64_t>& step, const std::optional<Tick>& tick, const char* otherwise) {
    if (!step && !tick) { return otherwise; }
    return (step ? "step " + grouped(*step) : std::string("the log's first step")) +
           (tick ? " at tick " + grouped(tick->value) : "");
}

std::string line_of(const MissingSteps& missing) {
    return fmt::format("  {} missing: {}, from {} to {}\n", missing.axis,
                       plural(missing.messages, "message") + " of steps",
                       place(missing.from_step, missing.from_tick, "its first step"),
                       place(missing.to_step, missing.to_tick, "the log's end"));
}

std::string line_of(const MissingRuns& missing) {
    return fmt::format("  {} missing: runs {} to {}\n", missing.axis, missing.numbers.from, missing.numbers.end - 1);
}

std::string line_of(const MissingChanges& missing) {
    const auto seconds = [](std::int64_t us) { return static_cast<double>(us) * 1e-6; };
    const std::string place = missing.from_us ? fmt::format("between {:.3f} s and {:.3f} s", seconds(*missing.from_us),
                                                            seconds(missing.to_us))
                                              : fmt::format("before {:.3f} s", seconds(missing.to_us));
    return fmt::format("  {} missing: {} of inputs and outputs, {} of machine time\n", missing.axis,
                       plural(missing.messages, "change"), place);
}

std::string line_of(const std::string& contradiction) { return "  contradiction: " + contradiction + "\n"; }

std::string line_of(const std::string& whose, std::int64_t messages, const char* what) {
    if (messages == 0) { return ""; }
    return fmt::format("  {} missing: {} of {}\n", whose, plural(messages, "message"), what);
}

template <typename Missing>
std::string lines_of(const std::vector<Missing>& all) {
    std::string text;
    for (std::size_t i = 0; i < all.size() && i < kLinesOfAnAxis; ++i) { text += line_of(all[i]); }
    if (all.size() > kLinesOfAnAxis) {
        text += fmt::format("  and {} more such places\n", all.size() - kLinesOfAnAxis);
    }
    return text;
}

std::string inputs_table(const Merged& merged) {
    std::string text = fmt::format("{:>12} {:>12}  log\n", "messages", "new in it");
    for (const MergedInput& input : merged.inputs) {
        text += fmt::format("{:>12} {:>12}  {}\n", grouped(static_cast<std::int64_t>(input.messages)),
                            grouped(static_cast<std::int64_t>(input.kept)), input.log.string());
        for (const analysis::Damage& damage : input.damages) {
            text += "  " + analysis::damage_sentence(damage) + "\n";
        }
    }
    return text;
}

std::string left_out_text(const ChosenLogs& chosen) {
    if (chosen.left_out.empty()) { return ""; }
    std::string text = fmt::format("left out: {} of {} (--all merges them as well)\n",
                                   plural(static_cast<std::int64_t>(chosen.left_out.size()), "log"),
                                   plural(chosen.sessions_left_out, "other session"));
    for (std::size_t i = 0; i < chosen.left_out.size() && i < kLinesOfAnAxis; ++i) {
        text += "  " + chosen.left_out[i].string() + "\n";
    }
    return text;
}

std::string axes_table(const Merged& merged) {
    std::string text = fmt::format("{:<16} {:>14} {:>10} {:>20}\n", merged.end.labels.has_motors() ? "motor" : "axis",
                                   "steps", "runs", "messages missing");
    for (const AxisRecord& axis : merged.axes) {
        text += fmt::format("{:<16} {:>14} {:>10} {:>20}\n", axis.axis, grouped(axis.steps), grouped(axis.runs),
                            grouped(axis.missing_messages()));
        text += lines_of(axis.missing_steps) + lines_of(axis.missing_runs) + lines_of(axis.missing_changes) +
                lines_of(axis.contradictions);
        text += line_of(axis.axis, axis.missing_positions, "positions") +
                line_of(axis.axis, axis.missing_figures, "figures");
        if (axis.changes_lost_by_device > 0) {
            text += fmt::format("  {} missing: {} of inputs and outputs, which its device could not keep\n", axis.axis,
                                plural(axis.changes_lost_by_device, "change"));
        }
    }
    return text;
}

std::string oddities(const Merged& merged) {
    const auto count = [](std::uint64_t number) { return plural(static_cast<std::int64_t>(number), "message"); };
    std::string text;
    if (merged.differing > 0) {
        text += count(merged.differing) + " left out: they have the number of another message, but other content\n";
    }
    for (const std::string& axis : merged.absent_axes) {
        text += fmt::format("  {} missing: all its messages, though the machine's file or a mark names it\n", axis);
    }
    text += line_of("jobs", merged.missing_job_events, "events") +
            line_of("jobs", merged.missing_program_parts, "programs");
    for (const std::string& line : analysis::missing_sentences(merged.end)) { text += "  " + line + "\n"; }
    if (merged.late > 0) {
        text += count(merged.late) + " were later than the window allows, and were written after newer messages\n";
    }
    if (merged.foreign > 0) { text += count(merged.foreign) + " of other channels, taken from each log\n"; }
    return text;
}

std::string result_of(const Merged& merged) {
    if (merged.contradicts()) { return "contradictory: messages of the logs exclude each other, as listed"; }
    if (!merged.is_complete()) { return "incomplete: the listed messages are in none of the logs"; }
    std::string text = merged.end.is_closed() ? "complete: no message of the record is missing"
                                              : "complete as far as is known: no message is known to be missing";
    for (const std::string& line : analysis::open_sentences(merged.end)) { text += "; " + line; }
    return text;
}

}  // namespace

std::string to_text(const Merged& merged, const std::filesystem::path& written) {
    return inputs_table(merged) + left_out_text(merged.chosen) + "\n" + axes_table(merged) + "\n" + oddities(merged) +
           fmt::format("{}: {} written, {} repeats left out\n{}\n", written.string(),
                       plural(static_cast<std::int64_t>(merged.messages), "message"),
                       grouped(static_cast<std::int64_t>(merged.duplicates)), result_of(merged));
}

}  // namespace lockstep::merge
