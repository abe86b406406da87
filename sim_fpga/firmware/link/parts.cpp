#include "sim_fpga/firmware/link/parts.hpp"

namespace lockstep::firmware {

static_assert((kMostMessageBytes - kHeaderBytes + kPartBytes - 1) / kPartBytes <= 31, "a word has a bit for each part");

void cut_part(const Message& message, std::size_t n, Message& part) {
    std::uint8_t* const to = part.bytes + kHeaderBytes;
    const std::size_t from = kHeaderBytes + n * kPartBytes;
    const std::size_t left = message.size - from;
    const std::size_t bytes = left < kPartBytes ? left : kPartBytes;
    to[0] = kPartMark;
    to[1] = static_cast<std::uint8_t>(n);
    to[2] = static_cast<std::uint8_t>(parts_of(message));
    for (std::size_t k = 0; k < bytes; ++k) { to[kPartHead + k] = message.bytes[from + k]; }
    part.size = kHeaderBytes + kPartHead + bytes;
}

/// All parts but the last have kPartBytes.
bool PartCollector::take(const Message& part) {
    const std::uint8_t* const from = part.bytes + kHeaderBytes;
    const std::size_t n = from[1];
    const std::size_t parts = from[2];
    const std::size_t bytes = part.size - kHeaderBytes - kPartHead;
    const bool is_last = n + 1 == parts;
    if (n >= parts || bytes > kPartBytes || (!is_last && bytes != kPartBytes)) { return false; }
    if (kHeaderBytes + n * kPartBytes + bytes > kMostMessageBytes) { return false; }
    if (there_ != 0 && parts != parts_) { return false; }
    parts_ = static_cast<std::uint8_t>(parts);
    for (std::size_t k = 0; k < bytes; ++k) { message_.bytes[kHeaderBytes + n * kPartBytes + k] = from[kPartHead + k]; }
    if (is_last) { message_.size = kHeaderBytes + n * kPartBytes + bytes; }
    there_ |= std::uint32_t{1} << n;
    return there_ == (std::uint32_t{1} << parts) - 1;
}

}  // namespace lockstep::firmware
