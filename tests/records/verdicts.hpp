// What verify, analyze, merge and replay say about a record, in one word each, with their sentences.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/findings.hpp"
#include "clients/verification/findings.hpp"
#include "tests/records/record.hpp"

namespace lockstep::records {

/// Bits, so that an expectation may allow several.
///
/// |          | verify, replay        | analyze  | merge                                       |
/// | Good     | exact                 | good     | complete                                    |
/// | Doubtful | -                     | doubtful | -                                           |
/// | Unknown  | something is unknown  | unknown  | messages are missing or cannot be read      |
/// | Bad      | a difference          | bad      | messages of one number differ               |
/// | Refused  | an error instead of a result                                                    |
enum Verdict : std::uint8_t { kSaysGood = 1, kSaysDoubtful = 2, kSaysUnknown = 4, kSaysBad = 8, kSaysRefused = 16 };
using Verdicts = std::uint8_t;

enum class Tool : std::uint8_t { Verify, Analyze, Merge, Replay };
inline constexpr std::size_t kTools = 4;
std::string_view name_of(Tool tool);
/// The tool's own word: "exact", "good", "complete".
std::string_view word_of(Tool tool, Verdict verdict);
/// "exact or unknown"
std::string words_of(Tool tool, Verdicts verdicts);

struct Judgement {
    Verdict verdict[kTools]{};
    std::string text[kTools];                 // why, for a failed test
    bool is_step_difference = false;          // verify found a difference of one axis
    bool verify_mentions = false;             // verify has a difference, an unknown result or a note
    bool merge_mentions = false;              // merge counts duplicates, losses or other things worth a line
    std::vector<analysis::Finding> findings;  // of analyze
    std::int64_t steps_verified = 0;

    Verdict of(Tool tool) const { return verdict[static_cast<std::size_t>(tool)]; }
    const std::string& text_of(Tool tool) const { return text[static_cast<std::size_t>(tool)]; }
};

/// Throws if a temporary file cannot be written.
Judgement judge(const Record& record);
Judgement judge_file(const std::filesystem::path& log);

/// Whether a finding is about the motion: its steps, moves or path. Faults and failed jobs are not.
bool is_about_motion(const analysis::Finding& finding);
/// Whether the finding says that all steps are there.
bool says_no_step_is_missing(const analysis::Finding& finding);

}  // namespace lockstep::records
