#include "services/board/spi_line.hpp"

#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "services/board/line_failure.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMostTransactions = 8;

}  // namespace

std::expected<SpiLine, std::string> SpiLine::open(const std::string& path, std::uint32_t speed_hz) {
    Descriptor line(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    if (!line.is_open()) { return line_not_opened(LinkName::Kind::Spi, path, errno); }
    std::uint8_t mode = SPI_MODE_0;
    std::uint8_t bits = 8;
    if (::ioctl(line.get(), SPI_IOC_WR_MODE, &mode) != 0) {
        return errno == ENOTTY ? line_failure(path, "it is no SPI device", "name one, such as /dev/spidev0.0")
                               : line_failure(path, std::string("mode 0: ") + std::strerror(errno), "use another SPI");
    }
    if (::flock(line.get(), LOCK_EX | LOCK_NB) != 0) { return line_is_held(path); }
    if (::ioctl(line.get(), SPI_IOC_WR_BITS_PER_WORD, &bits) != 0 ||
        ::ioctl(line.get(), SPI_IOC_WR_MAX_SPEED_HZ, &speed_hz) != 0) {
        return line_failure(path, std::to_string(speed_hz) + " Hz: " + std::strerror(errno),
                            "write another speed into the link, such as spi:" + path + "@1000000");
    }
    return SpiLine(std::move(line), speed_hz);
}

/// The chip is deselected between two transactions.
bool SpiLine::exchange(std::span<spi::Transaction> transactions) {
    std::array<spi_ioc_transfer, kMostTransactions> transfers{};
    if (transactions.size() > transfers.size()) { return false; }
    for (std::size_t n = 0; n < transactions.size(); ++n) {
        const auto bytes = reinterpret_cast<std::uintptr_t>(transactions[n].data());
        transfers[n].tx_buf = bytes;
        transfers[n].rx_buf = bytes;
        transfers[n].len = static_cast<std::uint32_t>(transactions[n].size());
        transfers[n].speed_hz = speed_hz_;
        transfers[n].cs_change = n + 1 < transactions.size() ? 1 : 0;
    }
    const auto request = _IOC(_IOC_WRITE, SPI_IOC_MAGIC, 0, transactions.size() * sizeof(spi_ioc_transfer));
    return ::ioctl(line_.get(), request, transfers.data()) >= 0;
}

}  // namespace lockstep
