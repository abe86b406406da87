// What the four tools must say about a record.
#pragma once

#include <string>
#include <vector>

#include "tests/records/verdicts.hpp"

namespace lockstep::records {

/// Each member allows one or several verdicts.
struct Expected {
    Verdicts verify = kGood;
    Verdicts analyze = kGood;
    Verdicts merge = kGood;
    Verdicts replay = kGood;

    Verdicts of(Tool tool) const {
        const Verdicts all[kTools]{verify, analyze, merge, replay};
        return all[static_cast<std::size_t>(tool)];
    }
};

/// Complete, and as commanded.
inline constexpr Expected kValid{};
/// Messages are lost: nobody can say whether the motion was right.
inline constexpr Expected kLost{kUnknown, kDoubtful | kUnknown, kUnknown, kUnknown};
/// Steps and runs contradict each other. A merge does not compare them.
inline constexpr Expected kOtherSteps{kBad, kBad, kGood | kUnknown, kBad};

/// Returns the laws that the judgement breaks, as sentences with the tools' own text. `removes_motion`: the record was
/// altered so that motion data is missing in it or is not what the machine made. `must_be_mentioned`: a tool that
/// leaves a message out of its comparison must say so.
std::vector<std::string> broken_laws(const Judgement& judgement, bool alters_motion, bool must_be_mentioned);
/// Returns the tools whose verdict is not expected, as sentences with the tools' own text.
std::vector<std::string> wrong_verdicts(const Judgement& judgement, const Expected& expected);

}  // namespace lockstep::records
