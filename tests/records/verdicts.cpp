#include "tests/records/verdicts.hpp"

#include <algorithm>
#include <array>

#include "clients/analysis/analysis.hpp"
#include "clients/merge/log_merge.hpp"
#include "clients/merge/report.hpp"
#include "clients/replay/replay.hpp"
#include "clients/verification/verification.hpp"

namespace lockstep::records {
namespace {

constexpr std::array kAll{kSaysGood, kSaysDoubtful, kSaysUnknown, kSaysBad, kSaysRefused};

/// Drops everything.
class NullSink final : public RecordSink {
public:
    void write(const std::string&, std::int64_t, std::span<const std::uint8_t>) override {}
};

Verdict verdict_of(const verification::Findings& findings) {
    if (findings.difference) { return kSaysBad; }
    return findings.is_exact() ? kSaysGood : kSaysUnknown;
}

void set(Judgement& judgement, Tool tool, Verdict verdict, std::string text) {
    judgement.verdict[static_cast<std::size_t>(tool)] = verdict;
    judgement.text[static_cast<std::size_t>(tool)] = std::move(text);
}

void ask_verify(const std::filesystem::path& log, Judgement& judgement) {
    const auto findings = verification::verify_log(log);
    if (!findings) {
        judgement.verify_mentions = true;
        return set(judgement, Tool::Verify, kSaysRefused, findings.error());
    }
    judgement.is_step_difference = findings->difference && !findings->difference->axis.empty();
    judgement.verify_mentions = !findings->is_exact() || !findings->notes.empty();
    judgement.steps_verified = findings->steps;
    set(judgement, Tool::Verify, verdict_of(*findings), verification::to_text(*findings));
}

void ask_analyze(const std::filesystem::path& log, Judgement& judgement) {
    constexpr std::array kGrades{kSaysGood, kSaysDoubtful, kSaysUnknown, kSaysBad};  // in the order of analysis::Grade
    const auto analysis = analysis::analyze_log(log);
    if (!analysis) { return set(judgement, Tool::Analyze, kSaysRefused, analysis.error()); }
    judgement.findings = analysis::findings(*analysis);
    std::string text;
    for (const auto& finding : judgement.findings) {
        text += std::string(analysis::name_of(finding.grade)) + ": " + finding.text + "\n";
    }
    const auto worst = static_cast<std::size_t>(analysis::worst_grade(judgement.findings));
    set(judgement, Tool::Analyze, kGrades.at(worst), text);
}

void ask_merge(const std::filesystem::path& log, Judgement& judgement) {
    NullSink sink;
    const auto merged = merge::merge_logs({.logs = {log}}, sink);
    if (!merged) { return set(judgement, Tool::Merge, kSaysRefused, merged.error()); }
    const bool is_damaged =
        std::ranges::any_of(merged->inputs, [](const auto& input) { return !input.damages.empty(); });
    const Verdict verdict = merged->contradicts()                  ? kSaysBad
                            : merged->is_complete() && !is_damaged ? kSaysGood
                                                                   : kSaysUnknown;
    judgement.merge_mentions = verdict != kSaysGood || merged->duplicates > 0 || merged->late > 0;
    set(judgement, Tool::Merge, verdict, merge::to_text(*merged, "merged.lcm"));
}

void ask_replay(const std::filesystem::path& log, Judgement& judgement) {
    const auto findings = replay::replay_log(log, nullptr);
    if (!findings) { return set(judgement, Tool::Replay, kSaysRefused, findings.error()); }
    set(judgement, Tool::Replay, verdict_of(*findings), replay::to_text(*findings));
}

bool has_any(const std::string& text, std::initializer_list<std::string_view> words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

}  // namespace

std::string_view name_of(Tool tool) {
    constexpr std::array<std::string_view, kTools> kNames{"verify", "analyze", "merge", "replay"};
    return kNames[static_cast<std::size_t>(tool)];
}

std::string_view word_of(Tool tool, Verdict verdict) {
    constexpr std::array<std::string_view, 5> kExact{"exact", "-", "unknown", "not exact", "refused"};
    constexpr std::array<std::string_view, 5> kGrade{"good", "doubtful", "unknown", "bad", "refused"};
    constexpr std::array<std::string_view, 5> kMerged{"complete", "-", "incomplete", "contradictory", "refused"};
    const auto at = static_cast<std::size_t>(std::ranges::find(kAll, verdict) - kAll.begin());
    if (tool == Tool::Analyze) { return kGrade.at(at); }
    return tool == Tool::Merge ? kMerged.at(at) : kExact.at(at);
}

std::string words_of(Tool tool, Verdicts verdicts) {
    std::string words;
    for (const Verdict verdict : kAll) {
        if ((verdicts & verdict) == 0 || word_of(tool, verdict) == "-") { continue; }
        words += (words.empty() ? "" : " or ") + std::string(word_of(tool, verdict));
    }
    return words;
}

Judgement judge_file(const std::filesystem::path& log) {
    Judgement judgement;
    ask_verify(log, judgement);
    ask_analyze(log, judgement);
    ask_merge(log, judgement);
    ask_replay(log, judgement);
    return judgement;
}

Judgement judge(const Record& record) {
    const auto log = record_folder() / "judged.lcm";
    write_record(record, log);
    Judgement judgement = judge_file(log);
    std::filesystem::remove(log);
    return judgement;
}

bool is_about_motion(const analysis::Finding& finding) {
    if (has_any(finding.text, {"fault", " failed"})) { return false; }
    return has_any(finding.text, {"step", "move", "path", "motion"});
}

bool says_no_step_is_missing(const analysis::Finding& finding) {
    return finding.grade == analysis::Grade::Good && finding.text.starts_with("no step") &&
           has_any(finding.text, {"missing"});
}

}  // namespace lockstep::records
