// Sends the bytes of a program to the coordinator in chunks: a few in flight at a time, each repeated until it is
// answered. Pure: the caller gives the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

inline constexpr std::size_t kChunkBytes = 32'768;  // the most a ProgramChunk may have
inline constexpr std::size_t kChunksInFlight = 16;  // well under what the topic keeps
inline constexpr std::chrono::milliseconds kRepeatAfter{300};

class ChunkedProgram {
public:
    /// Chunk i has the sequence number first_sequence + i. A program has at least one chunk.
    ChunkedProgram(Identity client, std::uint64_t first_sequence, std::uint64_t program,
                   std::vector<std::uint8_t> bytes);

    std::uint32_t count() const { return count_; }
    std::uint32_t answered() const { return answered_; }
    bool done() const { return answered_ == count_; }

    /// The chunks to send now: new ones as far as the window allows, and those whose answer is overdue.
    std::vector<ProgramChunk> due(std::chrono::nanoseconds now);
    /// Takes a reply. Sequence numbers of other requests are ignored.
    void take_answer(std::uint64_t sequence);

private:
    ProgramChunk chunk(std::uint32_t index) const;

    Identity client_;
    std::uint64_t first_sequence_;
    std::uint64_t program_;
    std::vector<std::uint8_t> bytes_;
    std::uint32_t count_;
    std::uint32_t sent_ = 0;  // the first so many
    std::uint32_t answered_ = 0;
    std::map<std::uint32_t, std::chrono::nanoseconds> in_flight_;  // when each was last sent
};

}  // namespace lockstep
