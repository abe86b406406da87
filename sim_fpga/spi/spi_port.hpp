// An SPI of the host, mode 0, the highest bit first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lockstep::spi {

/// Bytes that are exchanged while the chip is selected.
using Transaction = std::vector<std::uint8_t>;

class SpiPort {
public:
    virtual ~SpiPort() = default;
    /// Makes these transactions one after the other. Each then has the bytes that were received. Returns false if there
    /// is no port any more.
    virtual bool exchange(std::span<Transaction> transactions) = 0;

protected:
    SpiPort() = default;
    SpiPort(const SpiPort&) = default;
    SpiPort& operator=(const SpiPort&) = default;
};

}  // namespace lockstep::spi
