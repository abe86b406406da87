#include "sim_fpga/firmware/rp2040/usb_endpoint.hpp"

namespace lockstep::firmware {

using namespace usb_buffer;

/// The controller's clock is slower than the processor's: it must see all bits before it sees kAvailable.
void give_buffer(std::uint32_t address, std::uint32_t bits) {
    auto& half = *reinterpret_cast<volatile std::uint16_t*>(static_cast<std::uintptr_t>(address));
    half = static_cast<std::uint16_t>(bits & ~kAvailable);
    if ((bits & kAvailable) == 0) { return; }
    for (int n = 0; n < 4; ++n) { asm volatile("nop\n nop\n nop"); }
    half = static_cast<std::uint16_t>(bits);
}

void TwoBuffers::restart() {
    give_buffer(half(0), 0);
    give_buffer(half(1), 0);
    next_ = given_ = 0;
    is_second_kind_ = false;
    is_first_ = true;
}

void TwoBuffers::give(std::uint32_t bits) {
    const std::uint32_t kind = is_second_kind_ ? kSecondKind : 0;
    const std::uint32_t first = is_first_ ? kFirstBuffer : 0;
    give_buffer(half(next_), bits | kind | first | kAvailable);
    is_second_kind_ = !is_second_kind_;
    is_first_ = false;
    next_ ^= 1;
    ++given_;
}

bool TwoBuffers::has_done() const { return given_ > 0 && (look_at_buffer(half(oldest())) & kAvailable) == 0; }

}  // namespace lockstep::firmware
