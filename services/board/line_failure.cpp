#include "services/board/line_failure.hpp"

#include <cerrno>
#include <cstring>

namespace lockstep {
namespace {

std::string group_remedy(const std::string& group) {
    return "let this user use it: adduser USER " + group + ", then log in again";
}

std::string serial_remedy(int error) {
    if (error == EACCES) { return group_remedy("dialout"); }
    return "check the board's cable, and its name in /dev/serial/by-id";
}

std::string spi_remedy(int error) {
    switch (error) {
        case EACCES: return group_remedy("spi");
        case ENOENT:
        case ENXIO:
        case ENODEV:
            return "enable the SPI, on a Raspberry Pi by dtparam=spi=on in /boot/firmware/config.txt and a restart, "
                   "and compare the name with: ls /dev/spidev*";
        default: return "name an SPI device, such as /dev/spidev0.0";
    }
}

}  // namespace

std::unexpected<std::string> line_not_opened(LinkName::Kind kind, const std::string& path, int error) {
    if (error == EBUSY) { return line_is_held(path); }
    const bool is_spi = kind == LinkName::Kind::Spi;
    return line_failure(path, std::strerror(error), is_spi ? spi_remedy(error) : serial_remedy(error));
}

}  // namespace lockstep
