#include "services/coordinator/program_inbox.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/faults.hpp"

namespace lockstep {
namespace {

Reply reply_to(const ProgramChunk& chunk, const CommandResult& accepted) {
    Reply reply{.client = chunk.client, .sequence = chunk.sequence};
    if (accepted) {
        reply.parts = 1;  // an edit
        return reply;
    }
    reply.status = ReplyStatus::Refused;
    reply.fault = accepted.error().why;
    reply.text = accepted.error().text;
    return reply;
}

std::unexpected<Reply> refuse(const ProgramChunk& chunk, std::string why) {
    return std::unexpected(reply_to(chunk, refuse(FaultCode::BadProgram, std::move(why))));
}

}  // namespace

const ProgramInbox::Known* ProgramInbox::find(const ProgramChunk& chunk) const {
    const auto found = std::ranges::find_if(
        known_, [&](const Known& known) { return known.client == chunk.client && known.program == chunk.program; });
    return found == known_.end() ? nullptr : &*found;
}

std::expected<ProgramPart, Reply> ProgramInbox::read(const ProgramChunk& chunk) {
    if (chunk.count && chunk.index >= *chunk.count) {
        return refuse(chunk, fmt::format("chunk {} of {}: chunks are numbered from 0", chunk.index, *chunk.count));
    }
    const Known* known = find(chunk);
    if (known != nullptr && (known->is_edit || !known->accepted)) {
        return std::unexpected(reply_to(chunk, known->accepted));
    }
    ProgramPart part{.client = chunk.client,
                     .sequence = chunk.sequence,
                     .program = chunk.program,
                     .index = chunk.index,
                     .is_question = chunk.bytes.empty() && !chunk.count,
                     .is_last = chunk.index + 1 == chunk.count,
                     .share = chunk.share};
    const bool is_unknown = known == nullptr && chunk.index > 0;  // its first chunk was not received
    if (part.is_question || is_unknown) { return part; }
    const auto axes = chunk.index == 0 ? std::nullopt : std::optional(known->axes);
    auto document = program_document_from_bytes(chunk.bytes, axes);
    if (!document) { return refuse(chunk, document.error()); }
    CommandResult accepted;
    if (check_ && (known == nullptr || chunk.index > 0)) { accepted = check_(chunk, *document); }
    const bool is_edit = document->values && document->values->at_once;
    if (known == nullptr) {
        known_.push_back({chunk.client, chunk.program, document->program.axes.size(), is_edit, accepted});
        if (known_.size() > kProgramsKept) { known_.pop_front(); }
    }
    if (!accepted || is_edit) { return std::unexpected(reply_to(chunk, accepted)); }
    part.head = document->program.head();
    part.blocks = std::move(document->program.blocks);
    part.cut = std::move(document->cut);
    return part;
}

}  // namespace lockstep
