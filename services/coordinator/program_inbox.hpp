// Puts programs together from the chunks that clients send.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/program.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// Chunks may come again and out of order. A bounded number of programs is put together at a time, each bounded in
/// size; the oldest gives way.
class ProgramInbox {
public:
    struct Taken {
        Reply reply;                     // to the chunk
        std::optional<Program> program;  // whole now
        bool is_new = false;             // the chunk had not come before
    };
    Taken take(const ProgramChunk& chunk);

private:
    struct Parcel {
        std::uint64_t order = 0;
        std::uint32_t missing = 0;
        std::size_t bytes = 0;
        std::vector<std::optional<std::vector<std::uint8_t>>> chunks;
        Reply outcome;  // of the whole, once it is there
    };
    using Key = std::pair<Identity, std::uint64_t>;
    Parcel& parcel_of(const ProgramChunk& chunk);
    static Taken complete(Parcel& parcel, Reply reply);

    static constexpr std::size_t kMaxParcels = 4;
    static constexpr std::uint32_t kMaxChunks = 1U << 16;

    std::map<Key, Parcel> parcels_;
    std::uint64_t begun_ = 0;
};

}  // namespace lockstep
