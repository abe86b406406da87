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

    /// Whether the message is a part of it that is new.
    bool takes(const HeldMessage& message);
    /// Parts that are in no log.
    std::int64_t missing() const;

private:
    std::optional<ProgramInParts> program_;
    std::int64_t parts_ = 0;
    std::set<std::int64_t> came_;       // by their places in it
    std::set<std::int64_t> sequences_;  // of the messages
};

}  // namespace lockstep::merge
