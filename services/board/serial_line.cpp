#include "services/board/serial_line.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>

#include <cerrno>
#include <cstring>

#include "services/board/line_failure.hpp"

namespace lockstep {
/// Two hosts would each get a part of the bytes. TIOCEXCL does not keep root out, so there is a lock too.
std::expected<Descriptor, std::string> open_serial_line(const std::string& path, speed_t speed) {
    Descriptor line(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!line.is_open()) { return line_not_opened(LinkName::Kind::Serial, path, errno); }
    termios mode{};
    if (::tcgetattr(line.get(), &mode) != 0) { return line_failure(path, std::strerror(errno), "name a serial line"); }
    if (::flock(line.get(), LOCK_EX | LOCK_NB) != 0) { return line_is_held(path); }
    ::cfmakeraw(&mode);
    mode.c_cflag |= CLOCAL | CREAD | HUPCL;
    ::cfsetispeed(&mode, speed);
    ::cfsetospeed(&mode, speed);
    if (::tcsetattr(line.get(), TCSANOW, &mode) != 0) {
        return line_failure(path, std::strerror(errno), "use an adapter that can do 1 MBd");
    }
    ::ioctl(line.get(), TIOCEXCL);
    ::tcflush(line.get(), TCIOFLUSH);
    return line;
}

}  // namespace lockstep
