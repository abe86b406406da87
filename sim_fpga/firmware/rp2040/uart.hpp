// A line to a host: UART 0 at 1 MBd, 8 bits, no parity.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/link/line.hpp"

namespace lockstep::firmware {

class UartLine final : public Line {
public:
    void start();
    bool receive(std::uint8_t& byte) override;
    std::size_t send(const std::uint8_t* bytes, std::size_t size) override;
};

}  // namespace lockstep::firmware
