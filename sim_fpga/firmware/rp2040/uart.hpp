// The line to the host: UART 0 at 1 MBd, 8 bits, no parity.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/link/frame.hpp"

namespace lockstep::firmware {

void start_uart();
/// The next byte that was received. Returns false if there is none.
[[nodiscard]] bool receive(std::uint8_t& byte);

/// A frame on its way.
class Transmission {
public:
    Frame& frame() { return frame_; }
    bool is_done() const { return next_ >= frame_.size; }
    void begin() { next_ = 0; }
    /// Sends as many bytes as the UART takes now.
    void advance();

private:
    Frame frame_;
    std::size_t next_ = 0;
};

}  // namespace lockstep::firmware
