#include "sim_fpga/register_window.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim_fpga/page_guard.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kWords = registers::kWindowBytes / sizeof(std::uint64_t);

std::unexpected<std::string> system_error(const std::string& what, const char* action) {
    return std::unexpected(what + ": cannot " + action + ": " + std::strerror(errno));
}

/// Removes a mapping after its last use. The file stays open until then: its lock shows that the owner is alive.
struct Unmap {
    int file;
    std::string unlink_name;  // empty: not created here
    std::shared_ptr<PageGuard> guard;
    void operator()(std::uint64_t* words) {
        guard.reset();
        ::munmap(words, registers::kWindowBytes);
        if (!unlink_name.empty()) { ::shm_unlink(unlink_name.c_str()); }
        ::close(file);
    }
};

std::expected<std::string, std::string> shm_name(const std::string& name) {
    if (name.empty() || name.find('/') != std::string::npos) {
        return std::unexpected("shared memory \"" + name + "\": the name must be that of a file, without '/'");
    }
    return "/" + name;
}

bool lock(int file) { return ::flock(file, LOCK_EX | LOCK_NB) == 0; }

/// Removes the memory of a dead process. Returns false if a living process holds it.
bool remove_stale(const std::string& name) {
    const int file = ::shm_open(name.c_str(), O_RDWR, 0);
    if (file < 0) { return errno == ENOENT; }
    const bool stale = lock(file);
    if (stale) { ::shm_unlink(name.c_str()); }
    ::close(file);
    return stale;
}

bool long_enough(const struct stat& status) {
    return !S_ISREG(status.st_mode) || status.st_size >= static_cast<off_t>(registers::kWindowBytes);
}

}  // namespace

RegisterWindow RegisterWindow::in_process() { return RegisterWindow(std::make_shared<std::uint64_t[]>(kWords)); }

std::expected<RegisterWindow, std::string> RegisterWindow::create_shared(const std::string& name) {
    const auto path = shm_name(name);
    if (!path) { return std::unexpected(path.error()); }
    const std::string what = "shared memory \"" + name + "\"";
    if (!remove_stale(*path)) {
        return std::unexpected(what + ": in use by another device; end that one or choose another name");
    }
    const int file = ::shm_open(path->c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0660);
    if (file < 0) { return system_error(what, "create it"); }
    if (!lock(file) || ::ftruncate(file, static_cast<off_t>(registers::kWindowBytes)) != 0) {
        const auto error = system_error(what, "lock and size it");
        ::shm_unlink(path->c_str());
        ::close(file);
        return error;
    }
    return map(file, what, *path);
}

std::expected<RegisterWindow, std::string> RegisterWindow::open_shared(const std::string& name) {
    const auto path = shm_name(name);
    if (!path) { return std::unexpected(path.error()); }
    const std::string what = "shared memory \"" + name + "\"";
    const int file = ::shm_open(path->c_str(), O_RDWR | O_CLOEXEC, 0);
    return file < 0 ? system_error(what, "open it (is its device running?)") : map(file, what, {});
}

std::expected<RegisterWindow, std::string> RegisterWindow::create_file(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0660);
    if (file < 0) { return system_error(path.string(), "make it"); }
    // Empties the file, so that nothing of an earlier device is left. Locks it first, to keep that of a living device.
    if (!lock(file) || ::ftruncate(file, 0) != 0 ||
        ::ftruncate(file, static_cast<off_t>(registers::kWindowBytes)) != 0) {
        const auto error = system_error(path.string(), "lock and size it (is another device using it?)");
        ::close(file);
        return error;
    }
    return map(file, path.string(), {});
}

std::expected<RegisterWindow, std::string> RegisterWindow::open_file(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_SYNC | O_CLOEXEC);
    return file < 0 ? system_error(path.string(), "open it") : map(file, path.string(), {});
}

std::expected<RegisterWindow, std::string> RegisterWindow::map(int file, const std::string& what,
                                                               std::string unlink_name) {
    struct stat status {};
    if (::fstat(file, &status) != 0 || !long_enough(status)) {
        ::close(file);
        return std::unexpected(what + ": shorter than the register window's " +
                               std::to_string(registers::kWindowBytes) + " bytes");
    }
    void* memory = ::mmap(nullptr, registers::kWindowBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (memory == MAP_FAILED) {
        const auto error = system_error(what, "map it");
        ::close(file);
        return error;
    }
    auto guard = std::make_shared<PageGuard>(memory, registers::kWindowBytes);
    return RegisterWindow(std::shared_ptr<std::uint64_t[]>(static_cast<std::uint64_t*>(memory),
                                                           Unmap{file, std::move(unlink_name), std::move(guard)}),
                          !S_ISREG(status.st_mode));
}

}  // namespace lockstep
