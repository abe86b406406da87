// One result of the doctor.
#pragma once

#include <string>
#include <vector>

namespace lockstep::doctor {

enum class Rating { Good, Doubtful, Bad };

struct Finding {
    Rating rating = Rating::Good;
    std::string what;    // the checked property, in a word or two
    std::string found;   // its state, and the consequence if the state is not good
    std::string remedy;  // the command or the key that corrects it; empty if nothing needs to be done
    std::string host;    // the host concerned; empty if not known
};

using Findings = std::vector<Finding>;

}  // namespace lockstep::doctor
