#include "services/record/reading/record_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/number_text.hpp"
#include "services/record/reading/log_step.hpp"

namespace lockstep::analysis {
namespace {

constexpr std::array<RecordKind, 7> kNumbered{RecordKind::Steps,      RecordKind::Run,      RecordKind::Position,
                                              RecordKind::Health,     RecordKind::Channels, RecordKind::Job,
                                              RecordKind::ProgramPart};
constexpr std::array<const char*, 7> kNames{"steps",         "runs", "positions", "figures",
                                            kChannelChanges, "jobs", "programs"};

std::size_t index_of(RecordKind kind) {
    return static_cast<std::size_t>(std::ranges::find(kNumbered, numbered_with(kind)) - kNumbered.begin());
}

std::string name_of(const RecordingProcess& process, const MotorLabels& labels) {
    return process.axis.empty() ? "coordinator" : labels.of(process.axis);
}

std::string time_text(std::int64_t us) { return fmt::format("machine time {:.3f} s", static_cast<double>(us) * 1e-6); }

std::string sentence(const MissingEnd& missing, const MotorLabels& labels) {
    const auto& [from, end] = missing.numbers;
    return fmt::format("{}: {} of {} missing at the end (numbers {} to {}), published by {}",
                       name_of(missing.process, labels), plural(end - from, "message"),
                       kNames.at(index_of(missing.kind)), from, end - 1, time_text(missing.published_us));
}

std::string names_of(const std::vector<RecordingProcess>& processes, const MotorLabels& labels) {
    constexpr std::size_t kMost = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(processes.size(), kMost); ++i) {
        text += (i == 0 ? "" : ", ") + name_of(processes[i], labels);
    }
    return text + (processes.size() > kMost ? fmt::format(" and {} more", processes.size() - kMost) : "");
}

std::string names_of(const std::vector<OpenEnd>& ends, const MotorLabels& labels) {
    std::vector<RecordingProcess> processes;
    for (const OpenEnd& end : ends) { processes.push_back(end.process); }
    return names_of(processes, labels);
}

}  // namespace

std::int64_t RecordEnd::missing_messages() const {
    std::int64_t sum = 0;
    for (const MissingEnd& one : missing) { sum += one.numbers.end - one.numbers.from; }
    return sum;
}

bool RecordEnd::lacks_steps() const {
    return std::ranges::any_of(missing, [](const MissingEnd& one) { return one.kind == RecordKind::Steps; });
}

bool RecordEnd::lacks(RecordKind kind, const std::string& machine, const std::string& axis) const {
    return std::ranges::any_of(missing, [&](const MissingEnd& one) {
        return one.kind == kind && one.process.machine == machine && one.process.axis == axis;
    });
}

bool RecordEnd::may_lack_changes(const std::string& machine, const std::string& axis) const {
    const auto is_it = [&](const RecordingProcess& process) {
        return process.machine == machine && process.axis == axis;
    };
    const auto is_unmarked = [&](const OpenEnd& end) { return !end.known_us && is_it(end.process); };
    return lacks(RecordKind::Channels, machine, axis) || std::ranges::any_of(channels_not_counted, is_it) ||
           std::ranges::any_of(open, is_unmarked);
}

RecordEndCheck::Counted* RecordEndCheck::of(const std::string& machine, const std::string& axis,
                                            std::int64_t incarnation) {
    const auto is_last = [&] {
        return last_ != nullptr && last_process_->incarnation == incarnation && last_process_->axis == axis &&
               last_process_->machine == machine;
    };
    if (is_last()) { return last_; }
    if (processes_.size() == kMostProcesses) { return nullptr; }
    const auto found = processes_.try_emplace({machine, axis, incarnation}).first;
    last_process_ = &found->first;
    return last_ = &found->second;
}

void RecordEndCheck::saw(RecordKind kind, const std::string& machine, const std::string& axis, std::int64_t incarnation,
                         std::int64_t sequence) {
    Counted* counted = of(machine, axis, incarnation);
    if (counted == nullptr) { return; }
    const std::size_t of_kind = index_of(kind);
    if (of_kind == kNumbered.size()) { return; }  // marks do not count it
    std::optional<std::int64_t>& there = counted->there[of_kind];
    there = std::exchange(counted->is_seen[of_kind], true) ? std::max(*there, sequence + 1) : sequence + 1;
}

namespace {

/// nullopt: the mark does not count these.
using Count = std::optional<std::int64_t>;

std::array<Count, kNumbered.size()> counts_of(const RecordedMark& mark) {
    return {mark.steps,          mark.runs,       mark.positions,    mark.figures,
            mark.channel_events, mark.job_events, mark.program_parts};
}

bool is_possible(Count count) { return !count || is_message_number(*count); }

}  // namespace

void RecordEndCheck::take(const RecordedMark& mark) {
    if (!is_countable(mark.utime) || !std::ranges::all_of(counts_of(mark), is_possible)) { return; }
    Counted* counted = of(mark.machine, mark.process, mark.incarnation);
    if (counted == nullptr) { return; }
    first_us_ = first_us_.value_or(mark.utime);
    if (mark.witness == mark.process) { return hold_to(mark, *counted); }
    newest_us_ = std::max(newest_us_, mark.utime);
    counted->others.push_back(mark);
    while (counted->others.front().utime <= newest_us_ - kOnItsWay_us) {
        hold_to(counted->others.front(), *counted);
        counted->others.pop_front();
        if (counted->others.empty()) { return; }
    }
}

/// Whether the messages after this mark were published while this log was written.
bool RecordEndCheck::is_of_this_log(const RecordedMark& mark) const {
    return mark.witness == mark.process || mark.utime >= *first_us_ + kNoted_us;
}

void RecordEndCheck::hold_to(const RecordedMark& mark, Counted& counted) {
    newest_us_ = std::max(newest_us_, mark.utime);
    counted.ended = counted.ended || mark.ended != 0;
    counted.marked_us = std::max(counted.marked_us.value_or(mark.utime), mark.utime);
    const auto counts = counts_of(mark);
    counted.counts_channels = counted.counts_channels || mark.channel_events.has_value();
    for (std::size_t i = 0; i < kKinds; ++i) {
        const Count count = counts.at(i);
        if (!count) { continue; }
        if (!counted.there[i] && (*count == 0 || is_of_this_log(mark))) { counted.there[i] = count; }
        if (*count <= counted.published[i]) { continue; }
        counted.published[i] = *count;
        counted.published_us[i] = mark.utime;
    }
}

RecordEnd RecordEndCheck::finish() {
    RecordEnd end;
    for (auto& [process, counted] : processes_) {
        for (const RecordedMark& mark : counted.others) {
            if (mark.utime <= newest_us_ - kOnItsWay_us) { hold_to(mark, counted); }
        }
        counted.others.clear();
        for (std::size_t i = 0; i < kKinds; ++i) {
            if (counted.published[i] <= counted.there[i].value_or(counted.published[i])) { continue; }
            end.missing.push_back(
                {process, kNumbered.at(i), {*counted.there[i], counted.published[i]}, counted.published_us[i]});
        }
        const bool is_marked_axis = counted.marked_us && !process.axis.empty();
        if (is_marked_axis && !counted.counts_channels) { end.channels_not_counted.push_back(process); }
        if (!counted.ended) { end.open.push_back({process, counted.marked_us}); }
    }
    return end;
}

std::vector<std::string> missing_sentences(const RecordEnd& end) {
    std::vector<std::string> lines;
    for (const MissingEnd& missing : end.missing) { lines.push_back(sentence(missing, end.labels)); }
    return lines;
}

std::vector<std::string> open_sentences(const RecordEnd& end) {
    std::vector<OpenEnd> marked;
    std::vector<OpenEnd> unmarked;
    for (const OpenEnd& open : end.open) { (open.known_us ? marked : unmarked).push_back(open); }
    std::vector<std::string> lines;
    if (!marked.empty()) {
        const auto first = std::ranges::min_element(marked, {}, &OpenEnd::known_us);
        lines.push_back(
            fmt::format("the record is known to be complete up to {}; the end of {} is not recorded: messages "
                        "published after that may be missing",
                        time_text(*first->known_us), names_of(marked, end.labels)));
    }
    if (!unmarked.empty()) {
        lines.push_back(
            fmt::format("for {} it is not known whether the end is missing: no mark states how much was "
                        "published (an earlier version recorded the log, or the log was cut short)",
                        names_of(unmarked, end.labels)));
    }
    if (!end.channels_not_counted.empty()) {
        lines.push_back(
            fmt::format("for {} it is not known whether changes of inputs and outputs are missing at the end: no mark "
                        "counts them (an earlier version recorded the log)",
                        names_of(end.channels_not_counted, end.labels)));
    }
    return lines;
}

}  // namespace lockstep::analysis
