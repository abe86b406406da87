// What the doctor says of one thing.
#pragma once

#include <string>
#include <vector>

namespace lockstep::doctor {

enum class Verdict { Good, Doubtful, Bad };

struct Finding {
    Verdict verdict = Verdict::Good;
    std::string what;    // was looked at, in a word or two
    std::string found;   // and what it costs where it is not good
    std::string remedy;  // the command or the key that mends it; empty: nothing needs to be done
    std::string host;    // of which this is said; empty: not known
};

using Findings = std::vector<Finding>;

}  // namespace lockstep::doctor
