#include "tests/records/expected.hpp"

#include <algorithm>

namespace lockstep::records {
namespace {

using analysis::Finding;
using analysis::Grade;

bool any(const Judgement& judgement, Grade grade) {
    return std::ranges::any_of(judgement.findings,
                               [&](const Finding& found) { return found.grade == grade && is_about_motion(found); });
}

std::string both(const std::string& law, const Judgement& judgement) {
    return law + "\n-- verify: " + judgement.text_of(Tool::Verify) + "-- analyze: " + judgement.text_of(Tool::Analyze);
}

/// verify and analyze do not contradict each other about steps and paths.
void check_agreement(const Judgement& judgement, const Expected& expected, std::vector<std::string>& broken) {
    const Verdict verify = judgement.of(Tool::Verify);
    const bool is_bad = any(judgement, Grade::Bad);
    const bool is_unknown = any(judgement, Grade::Unknown);
    if (verify == kSaysGood && is_bad && !expected.leaves_path) {
        broken.push_back(both("verify says exact, analyze says bad of steps or paths", judgement));
    }
    if (verify == kSaysGood && is_unknown && !expected.begins_late) {
        broken.push_back(both("verify says exact, analyze says unknown of steps", judgement));
    }
    if (verify == kSaysUnknown && is_bad) {
        broken.push_back(both("verify says unknown, analyze says bad of steps or paths", judgement));
    }
    if (verify == kSaysUnknown && judgement.of(Tool::Analyze) == kSaysGood) {
        broken.push_back(both("verify says unknown, analyze says good", judgement));
    }
    if (judgement.is_step_difference && !is_bad && !is_unknown && !any(judgement, Grade::Doubtful)) {
        broken.push_back(
            both("verify found a difference of an axis, analyze has only good findings of motion", judgement));
    }
}

}  // namespace

std::vector<std::string> broken_laws(const Judgement& judgement, const Expected& expected, Altered altered) {
    std::vector<std::string> broken;
    check_agreement(judgement, expected, broken);
    const bool claims_all = std::ranges::any_of(judgement.findings, says_no_step_is_missing);
    if (altered.motion && judgement.of(Tool::Verify) == kSaysGood && claims_all) {
        broken.push_back(both("altered motion is exact, and no step is missing", judgement));
    }
    if (altered.must_be_mentioned && !judgement.verify_mentions) {
        broken.push_back("verify left a message out and reports nothing\n" + judgement.text_of(Tool::Verify));
    }
    if (altered.must_be_mentioned && !judgement.merge_mentions) {
        broken.push_back("merge left a message out and reports nothing\n" + judgement.text_of(Tool::Merge));
    }
    return broken;
}

std::vector<std::string> wrong_verdicts(const Judgement& judgement, const Expected& expected) {
    std::vector<std::string> wrong;
    for (const Tool tool : {Tool::Verify, Tool::Analyze, Tool::Merge, Tool::Replay}) {
        const Verdict said = judgement.of(tool);
        if ((said & expected.of(tool)) != 0) { continue; }
        wrong.push_back(std::string(name_of(tool)) + " says " + std::string(word_of(tool, said)) + ", not " +
                        words_of(tool, expected.of(tool)) + "\n" + judgement.text_of(tool));
    }
    return wrong;
}

}  // namespace lockstep::records
