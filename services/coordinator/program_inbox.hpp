// Assembles programs from the chunks that clients send.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/program.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {

/// Accepts chunks repeated and out of order. Assembles a bounded number of programs at a time, each of bounded size; a
/// new one replaces the oldest.
class ProgramInbox {
public:
    struct Taken {
        Reply reply;                     // to the chunk
        std::optional<Program> program;  // once it is complete; an edit has none
        bool is_new = false;             // the chunk was not received before
    };
    /// Whether a program that is complete is accepted. Error: why not.
    using Check = std::function<std::expected<void, std::string>(std::uint64_t id, const ProgramDocument& program)>;
    explicit ProgramInbox(Check check = {}) : check_(std::move(check)) {}
    Taken take(const ProgramChunk& chunk);

private:
    struct Parcel {
        std::uint64_t order = 0;
        std::uint32_t missing = 0;
        std::size_t bytes = 0;
        std::vector<std::optional<std::vector<std::uint8_t>>> chunks;
        Reply outcome;  // for the whole program, once it is complete
    };
    using Key = std::pair<Identity, std::uint64_t>;
    Parcel& parcel_of(const ProgramChunk& chunk);
    Taken complete(std::uint64_t id, Parcel& parcel, Reply reply) const;

    static constexpr std::size_t kMaxParcels = 4;
    static constexpr std::uint32_t kMaxChunks = 1U << 16;

    Check check_;
    std::map<Key, Parcel> parcels_;
    std::uint64_t begun_ = 0;
};

}  // namespace lockstep
