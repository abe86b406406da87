#include "clients/session/chunked_program.hpp"

#include <algorithm>

namespace lockstep {

ChunkedProgram::ChunkedProgram(Identity client, std::uint64_t first_sequence, std::uint64_t program,
                               std::vector<std::uint8_t> bytes)
    : client_(client),
      first_sequence_(first_sequence),
      program_(program),
      bytes_(std::move(bytes)),
      count_(static_cast<std::uint32_t>(std::max<std::size_t>(1, (bytes_.size() + kChunkBytes - 1) / kChunkBytes))) {}

std::vector<ProgramChunk> ChunkedProgram::due(std::chrono::nanoseconds now) {
    std::vector<ProgramChunk> chunks;
    for (auto& [index, sent] : in_flight_) {
        if (now - sent < kRepeatAfter) { continue; }
        chunks.push_back(chunk(index));
        sent = now;
    }
    for (; sent_ < count_ && in_flight_.size() < kChunksInFlight; ++sent_) {
        chunks.push_back(chunk(sent_));
        in_flight_[sent_] = now;
    }
    return chunks;
}

void ChunkedProgram::take_answer(std::uint64_t sequence) {
    if (sequence < first_sequence_ || sequence - first_sequence_ >= count_) { return; }
    answered_ += static_cast<std::uint32_t>(in_flight_.erase(static_cast<std::uint32_t>(sequence - first_sequence_)));
}

ProgramChunk ChunkedProgram::chunk(std::uint32_t index) const {
    const std::size_t from = index * kChunkBytes;
    const std::size_t to = std::min(from + kChunkBytes, bytes_.size());
    return {.client = client_,
            .sequence = first_sequence_ + index,
            .program = program_,
            .index = index,
            .count = count_,
            .bytes = {bytes_.begin() + static_cast<std::ptrdiff_t>(from),
                      bytes_.begin() + static_cast<std::ptrdiff_t>(to)}};
}

}  // namespace lockstep
