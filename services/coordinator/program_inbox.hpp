// Reads the chunks of programs that clients send.
#pragma once

#include <cstdint>
#include <deque>
#include <expected>
#include <functional>
#include <string>

#include "core/coordinator/state/refusal.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {

/// Knows of the newest programs how many axes they have, and whether they were accepted.
class ProgramInbox {
public:
    /// Of a chunk that is read: whether its program is accepted, where it is the first one, and the values that the
    /// program leaves. Error: why it is refused.
    using Check = std::function<CommandResult(const ProgramChunk& chunk, const ProgramDocument& part)>;
    explicit ProgramInbox(Check check = {}) : check_(std::move(check)) {}

    /// Error: the reply to a chunk that is refused, or that is an edit of the machine's values and so nothing to run.
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
