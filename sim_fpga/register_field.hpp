// A group of bits in a word of the register map.
#pragma once

#include <cstdint>

namespace lockstep {

struct RegisterField {
    unsigned low = 0;   // its lowest bit
    unsigned bits = 0;  // how many; below 64

    /// The field's value in a word.
    constexpr std::uint64_t of(std::uint64_t word) const { return (word >> low) & mask(); }
    /// A word with this value in the field, and zeros elsewhere. Keeps the low bits of a value that is too large.
    constexpr std::uint64_t word(std::uint64_t value) const { return (value & mask()) << low; }
    /// Whether the field shows the low bits of this value.
    constexpr bool shows(std::uint64_t in, std::uint64_t value) const { return of(in) == (value & mask()); }

private:
    constexpr std::uint64_t mask() const { return (std::uint64_t{1} << bits) - 1; }
};

}  // namespace lockstep
