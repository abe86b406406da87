// CRC-32 with the polynomial 0xEDB88320, as in zlib.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lockstep::exporting {

class Crc32 {
public:
    constexpr Crc32& add(std::string_view bytes) {
        for (const char c : bytes) { rest_ = kTable[(rest_ ^ static_cast<std::uint8_t>(c)) & 0xFFU] ^ (rest_ >> 8U); }
        return *this;
    }
    constexpr std::uint32_t value() const { return ~rest_; }

private:
    /// The remainder of each byte.
    static constexpr std::array<std::uint32_t, 256> kTable = [] {
        std::array<std::uint32_t, 256> table{};
        for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
            table[byte] = byte;
            for (int bit = 0; bit < 8; ++bit) {
                table[byte] = (table[byte] >> 1U) ^ ((table[byte] & 1U) != 0 ? 0xEDB88320U : 0U);
            }
        }
        return table;
    }();
    std::uint32_t rest_ = 0xFFFFFFFFU;
};

}  // namespace lockstep::exporting
