#include "sim_fpga/firmware/link/crc32.hpp"

namespace lockstep::firmware {
namespace {

struct NibbleTable {
    std::uint32_t rest[16];
};

/// The remainders of four bits: a table that is small enough for a board.
constexpr NibbleTable make_nibble_table() {
    NibbleTable table{};
    for (std::uint32_t n = 0; n < 16; ++n) {
        std::uint32_t rest = n;
        for (int bit = 0; bit < 4; ++bit) { rest = rest >> 1 ^ ((rest & 1) != 0 ? 0xEDB8'8320 : 0); }
        table.rest[n] = rest;
    }
    return table;
}

constexpr NibbleTable kNibbles = make_nibble_table();

}  // namespace

std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size) {
    std::uint32_t rest = ~std::uint32_t{0};
    for (std::size_t n = 0; n < size; ++n) {
        rest ^= bytes[n];
        rest = rest >> 4 ^ kNibbles.rest[rest & 15];
        rest = rest >> 4 ^ kNibbles.rest[rest & 15];
    }
    return ~rest;
}

}  // namespace lockstep::firmware
