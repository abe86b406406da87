// The places of a ring's entries in the register window.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep {

class RegisterRing {
public:
    /// offset, entry_bytes: in bytes. entries: a power of two.
    constexpr RegisterRing(std::size_t offset, std::size_t entries, std::size_t entry_bytes)
        : offset_(offset), entries_(entries), entry_bytes_(entry_bytes) {}

    constexpr std::uint64_t entries() const { return entries_; }
    /// The byte at which entry `index` begins. Entries are numbered from power-up on.
    constexpr std::size_t entry(std::uint64_t index) const { return offset_ + index % entries_ * entry_bytes_; }

private:
    std::size_t offset_;
    std::uint64_t entries_;
    std::size_t entry_bytes_;
};

}  // namespace lockstep
