// A message in parts, for a line on which long messages do not arrive.
//
// A part stands in place of a message's items: kPartMark, the part's number (1 byte), how many parts there are (1), its
// bytes. The parts of a message may come in any order, and each more than once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/link/items.hpp"

namespace lockstep::firmware {

/// In place of a motor's number.
inline constexpr std::uint8_t kPartMark = 0xFF;
inline constexpr std::size_t kPartBytes = 8;
inline constexpr std::size_t kPartHead = 3;

inline std::size_t parts_of(const Message& message) {
    return (message.size - kHeaderBytes + kPartBytes - 1) / kPartBytes;
}
inline bool is_part(const Message& message) {
    return message.size > kHeaderBytes + kPartHead && message.bytes[kHeaderBytes] == kPartMark;
}
/// Makes part `n` of a message. The part's header is not written.
void cut_part(const Message& message, std::size_t n, Message& part);

/// Puts the parts of one message together.
class PartCollector {
public:
    /// The parts of another message follow.
    void clear() { there_ = 0; }
    /// Takes a part. Returns true if the message is whole now.
    bool take(const Message& part);
    const Message& message() const { return message_; }

private:
    Message message_;
    std::uint32_t there_ = 0;  // part n is bit n
    std::uint8_t parts_ = 0;
};

}  // namespace lockstep::firmware
