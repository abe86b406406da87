// The verdicts that the four tools must give about a record.
#pragma once

#include <string>
#include <vector>

#include "tests/records/verdicts.hpp"

namespace lockstep::records {

/// Each member allows one or several verdicts.
struct Expected {
    Verdicts verify = kSaysGood;
    Verdicts analyze = kSaysGood;
    Verdicts merge = kSaysGood;
    Verdicts replay = kSaysGood;
    /// The log lacks the record's beginning. verify may then be exact from a later job on, though analyze does not know
    /// an earlier one.
    bool begins_late = false;
    /// By a fault in the record motors left the path. verify compares their steps with their frames, analyze with the
    /// path.
    bool leaves_path = false;

    Verdicts of(Tool tool) const {
        const Verdicts all[kTools]{verify, analyze, merge, replay};
        return all[static_cast<std::size_t>(tool)];
    }
};

/// Complete, and as commanded.
inline constexpr Expected kValid{};
/// A job failed. Its steps are as planned.
inline constexpr Expected kFailed{kSaysGood, kSaysDoubtful | kSaysBad, kSaysGood, kSaysGood};
/// The same, and a motor went on without the others.
inline constexpr Expected kLeftPath{kSaysGood, kSaysBad, kSaysGood, kSaysGood, false, true};
/// Messages are lost: nobody can say whether the motion was right.
inline constexpr Expected kLost{kSaysUnknown, kSaysDoubtful | kSaysUnknown, kSaysUnknown, kSaysUnknown};
/// Steps and runs contradict each other. A merge does not compare them.
inline constexpr Expected kOtherSteps{kSaysBad, kSaysBad, kSaysGood | kSaysUnknown, kSaysBad};

/// A replay compares steps with runs only; other messages are nothing to it.
inline constexpr Verdicts kReplayedAlike = kSaysGood | kSaysUnknown;

/// How a record was altered.
struct Altered {
    bool motion = false;             // data of the motion is missing, or is not what the machine made
    bool must_be_mentioned = false;  // a tool that leaves the message out of its comparison must say so
};

/// No data of the motion is altered.
inline constexpr Altered kNoMotion{.motion = false};

/// Returns the laws that the judgement breaks, as sentences with the tools' own text.
std::vector<std::string> broken_laws(const Judgement& judgement, const Expected& expected, Altered altered = {});
/// Returns the tools whose verdict is not expected, as sentences with the tools' own text.
std::vector<std::string> wrong_verdicts(const Judgement& judgement, const Expected& expected);

}  // namespace lockstep::records
