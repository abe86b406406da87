// For tests, by LD_PRELOAD: a socket of spidev_of_pins in the place of an SPI device. Opening it connects, and the
// requests of spidev go there. Everything else goes to the system.
#include <fcntl.h>
#include <linux/spi/spidev.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace {

bool is_socket(const char* path) {
    struct stat found {};
    return ::stat(path, &found) == 0 && S_ISSOCK(found.st_mode);
}

int connect_to(const char* path) {
    sockaddr_un to{.sun_family = AF_UNIX, .sun_path = {}};
    std::snprintf(to.sun_path, sizeof to.sun_path, "%s", path);
    const int line = ::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    if (line >= 0 && ::connect(line, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) { return line; }
    ::close(line);
    errno = ENODEV;
    return -1;
}

int open_any(const char* path, int flags, mode_t mode) {
    if (is_socket(path)) { return connect_to(path); }
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

/// One message each way for each transaction.
int transfer(int line, const spi_ioc_transfer* transfers, std::size_t count) {
    for (std::size_t n = 0; n < count; ++n) {
        const spi_ioc_transfer& one = transfers[n];
        auto* const bytes = reinterpret_cast<void*>(one.rx_buf);
        const bool is_done = one.tx_buf == one.rx_buf && (one.cs_change != 0) == (n + 1 < count) &&
                             ::send(line, bytes, one.len, MSG_NOSIGNAL) == static_cast<ssize_t>(one.len) &&
                             ::recv(line, bytes, one.len, 0) == static_cast<ssize_t>(one.len);
        if (!is_done) {
            errno = EIO;
            return -1;
        }
    }
    return 1;
}

int answer(int line, unsigned long request, void* argument) {
    switch (request) {
        case SPI_IOC_WR_MODE:
            if (*static_cast<const std::uint8_t*>(argument) == SPI_MODE_0) { return 0; }
            break;
        case SPI_IOC_WR_BITS_PER_WORD:
            if (*static_cast<const std::uint8_t*>(argument) == 8) { return 0; }
            break;
        case SPI_IOC_WR_MAX_SPEED_HZ: return 0;
        default:
            if (_IOC_NR(request) == 0 && _IOC_SIZE(request) % sizeof(spi_ioc_transfer) == 0) {
                return transfer(line, static_cast<const spi_ioc_transfer*>(argument),
                                _IOC_SIZE(request) / sizeof(spi_ioc_transfer));
            }
    }
    errno = EINVAL;
    return -1;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open_any(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open_any(path, flags, mode);
}

int ioctl(int file, unsigned long request, ...) {
    va_list more;
    va_start(more, request);
    void* const argument = va_arg(more, void*);
    va_end(more);
    struct stat found {};
    const bool is_spi = _IOC_TYPE(request) == SPI_IOC_MAGIC && ::fstat(file, &found) == 0 && S_ISSOCK(found.st_mode);
    if (is_spi) { return answer(file, request, argument); }
    return static_cast<int>(::syscall(SYS_ioctl, file, request, argument));
}
}
