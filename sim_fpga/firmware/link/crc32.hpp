// CRC-32 as in Ethernet and zip (reflected, polynomial 0x04C11DB7).
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep::firmware {

/// Detects every burst of up to 32 bits in a message.
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size);

}  // namespace lockstep::firmware
