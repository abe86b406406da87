// The parts of the one program that a merged job runs. They may have been recorded long before the job: a program is
// recorded when it is received, and may be run again later.
#pragma once

#include <cstdint>
#include <optional>
#include <set>

#include "clients/merge/merge_input.hpp"
#include "clients/merge/sessions.hpp"

namespace lockstep::merge {

class JobProgram {
public:
    explicit JobProgram(std::optional<ProgramInParts> program) : program_(program) {}

    /// Returns true if the message is a new part of the program.
    bool takes(const HeldMessage& message);
    /// Number of parts that no log contains.
    std::int64_t missing() const;

private:
    std::optional<ProgramInParts> program_;
    std::int64_t parts_ = 0;
    std::set<std::int64_t> came_;       // indices of the parts that were found
    std::set<std::int64_t> sequences_;  // sequence numbers of their messages
};

}  // namespace lockstep::merge
