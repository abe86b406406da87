#include "services/coordinator/program_inbox.hpp"

#include <algorithm>
#include <string>

#include "core/faults.hpp"

namespace lockstep {
namespace {

Reply refuse(Reply reply, std::string why) {
    reply.status = ReplyStatus::Refused;
    reply.fault = static_cast<std::uint16_t>(FaultCode::BadProgram);
    reply.text = std::move(why);
    return reply;
}

}  // namespace

ProgramInbox::Taken ProgramInbox::take(const ProgramChunk& chunk) {
    Reply reply{.client = chunk.client, .sequence = chunk.sequence};
    if (chunk.count == 0 || chunk.count > kMaxChunks || chunk.index >= chunk.count) {
        return {refuse(reply, "chunk " + std::to_string(chunk.index) + " of " + std::to_string(chunk.count) +
                                  ": a program has 1 to " + std::to_string(kMaxChunks) + " chunks"),
                {}};
    }
    Parcel& parcel = parcel_of(chunk);
    if (chunk.count != parcel.chunks.size()) {
        return {refuse(reply, "the program's chunks do not agree on how many there are"), {}};
    }
    if (parcel.missing == 0) {
        parcel.outcome.sequence = chunk.sequence;
        return {parcel.outcome, {}};
    }
    auto& place = parcel.chunks[chunk.index];
    if (place) { return {reply, {}}; }
    parcel.bytes += chunk.bytes.size();
    if (parcel.bytes > kMaxProgramBytes) {
        return {
            refuse(reply, "the program is larger than " + std::to_string(kMaxProgramBytes) + " bytes; cut it in two"),
            {}};
    }
    place = chunk.bytes;
    Taken taken = --parcel.missing == 0 ? complete(chunk.program, parcel, reply) : Taken{reply, {}};
    taken.is_new = true;
    return taken;
}

ProgramInbox::Parcel& ProgramInbox::parcel_of(const ProgramChunk& chunk) {
    const auto [found, made] = parcels_.try_emplace({chunk.client, chunk.program});
    if (!made) { return found->second; }
    found->second.order = ++begun_;
    found->second.missing = chunk.count;
    found->second.chunks.resize(chunk.count);
    if (parcels_.size() > kMaxParcels) {
        parcels_.erase(std::min_element(parcels_.begin(), parcels_.end(),
                                        [](const auto& a, const auto& b) { return a.second.order < b.second.order; }));
    }
    return parcels_.at({chunk.client, chunk.program});
}

ProgramInbox::Taken ProgramInbox::complete(std::uint64_t id, Parcel& parcel, Reply reply) const {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(parcel.bytes);
    for (auto& chunk : parcel.chunks) {
        bytes.insert(bytes.end(), chunk->begin(), chunk->end());
        chunk.emplace();
    }
    auto document = program_document_from_bytes(bytes);
    std::expected<void, std::string> accepted;
    if (!document) { accepted = std::unexpected(document.error()); }
    if (document && check_) { accepted = check_(id, *document); }
    parcel.outcome = accepted ? reply : refuse(reply, accepted.error());
    Taken taken{parcel.outcome, {}};
    const bool is_edit = document && document->values && document->values->at_once;
    if (accepted && !is_edit) { taken.program = std::move(document->program); }
    return taken;
}

}  // namespace lockstep
