// An SPI device of Linux, /dev/spidevB.C.
#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "services/files/descriptor.hpp"
#include "sim_fpga/spi/spi_port.hpp"

namespace lockstep {

class SpiLine final : public spi::SpiPort {
public:
    /// Opens it for one program alone, with mode 0. Error: why this is not possible, and the remedy.
    static std::expected<SpiLine, std::string> open(const std::string& path, std::uint32_t speed_hz);

    bool exchange(std::span<spi::Transaction> transactions) override;
    /// Of transactions from now on. The host's SPI may be slower, not faster.
    void set_speed(std::uint32_t speed_hz) { speed_hz_ = speed_hz; }

private:
    SpiLine(Descriptor line, std::uint32_t speed_hz) : line_(std::move(line)), speed_hz_(speed_hz) {}

    Descriptor line_;
    std::uint32_t speed_hz_;
};

}  // namespace lockstep
