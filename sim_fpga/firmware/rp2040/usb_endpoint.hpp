// Endpoints of the chip's USB controller: packets wait in its memory, which has a control word for each end.
//
// The line's ends have two buffers that take turns: while the controller works on one, the processor works on the
// other. Each half of a control word belongs to a buffer, and is written by itself, so that a write does not undo what
// the controller writes into the other half.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/usb/descriptors.hpp"

namespace lockstep::firmware {

/// A buffer's half of a control word, without what the endpoint adds.
namespace usb_buffer {
inline constexpr std::uint32_t kFull = 1 << 15, kSecondKind = 1 << 13, kFirstBuffer = 1 << 12, kRefused = 1 << 11,
                               kAvailable = 1 << 10, kLength = 0x3FF;
}  // namespace usb_buffer

/// Gives a buffer to the controller, or with 0 takes it away. `address`: of its half.
void give_buffer(std::uint32_t address, std::uint32_t bits);
inline std::uint32_t look_at_buffer(std::uint32_t address) {
    return *reinterpret_cast<volatile std::uint16_t*>(static_cast<std::uintptr_t>(address));
}

/// An end with two buffers. Packets are of two kinds in turn (DATA0, DATA1), by which a repeated one is known.
class TwoBuffers {
public:
    /// control: the address of the control word. memory: of the first buffer; the second one follows it.
    constexpr TwoBuffers(std::uint32_t control, std::uint32_t memory) : control_(control), memory_(memory) {}

    /// Both buffers are the processor's, and the next packet is DATA0.
    void restart();
    bool has_free() const { return given_ < 2; }
    /// The memory of the buffer that is given next.
    volatile std::uint8_t* next() const { return memory_of(next_); }
    /// has_free() must hold.
    void give(std::uint32_t bits);
    /// Whether the controller has done with the oldest buffer that was given.
    bool has_done() const;
    /// has_done() must hold. The memory of that buffer, and how many bytes it has.
    const volatile std::uint8_t* done() const { return memory_of(oldest()); }
    std::size_t done_bytes() const { return look_at_buffer(half(oldest())) & usb_buffer::kLength; }
    /// That buffer is free.
    void release() { --given_; }

private:
    unsigned oldest() const { return (next_ + given_) & 1; }
    std::uint32_t half(unsigned buffer) const { return control_ + 2 * buffer; }
    volatile std::uint8_t* memory_of(unsigned buffer) const {
        return reinterpret_cast<volatile std::uint8_t*>(static_cast<std::uintptr_t>(memory_)) +
               buffer * usb::kPacketBytes;
    }

    std::uint32_t control_;
    std::uint32_t memory_;
    unsigned next_ = 0;   // the buffer that is given next
    unsigned given_ = 0;  // buffers that are the controller's, or done
    bool is_second_kind_ = false;
    bool is_first_ = true;
};

}  // namespace lockstep::firmware
