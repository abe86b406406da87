// Reads the chunks of programs that clients send.
#pragma once

#include <cstdint>
#include <deque>
#include <expected>
#include <functional>

#include "core/coordinator/state/refusal.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {

/// Remembers the newest programs: how many axes each has, and whether it was accepted.
class ProgramInbox {
public:
    /// Called for each chunk that is read. It accepts or refuses the program at its first chunk, and takes the values
    /// that the program leaves from a later one. Error: why the program is refused.
    using Check = std::function<CommandResult(const ProgramChunk& chunk, const ProgramDocument& part)>;
    explicit ProgramInbox(Check check = {}) : check_(std::move(check)) {}

    /// Error: the reply to a refused chunk, or to an edit of the machine's values, which contains nothing to run.
    std::expected<ProgramPart, Reply> read(const ProgramChunk& chunk);

private:
    struct Known {
        Identity client = 0;
        std::uint64_t program = 0;
        std::size_t axes = 0;
        bool is_edit = false;
        CommandResult accepted;
    };
    const Known* find(const ProgramChunk& chunk) const;

    static constexpr std::size_t kProgramsKept = 32;

    Check check_;
    std::deque<Known> known_;
};

}  // namespace lockstep
