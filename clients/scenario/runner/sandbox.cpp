#include "clients/scenario/runner/sandbox.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace lockstep::scenario {
namespace {

constexpr char kResult = '+';  // the first byte of the output
constexpr char kError = '-';

std::string why(const std::string& what) {
    return what + ": " + std::strerror(errno) + "; a scenario runs in namespaces of its own, which only root can make";
}

/// Mounts memory over the directories of the host. Returns an empty text, or why it failed.
std::string make_own_folders() {
    if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) {
        return why("cannot make the mounts private");
    }
    if (mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr) != 0) {
        return why("cannot mount /proc");
    }
    for (const char* path : {"/dev/shm", "/run"}) {  // /run: names of networks, the firewall's lock
        if (mount("tmpfs", path, "tmpfs", MS_NOSUID | MS_NODEV, nullptr) != 0) {
            return why("cannot mount " + std::string(path));
        }
    }
    std::error_code error;
    std::filesystem::create_directories(sandbox_folder(), error);
    return error ? "cannot create " + sandbox_folder().string() + ": " + error.message() : "";
}

/// The first process of the sandbox: when it ends, the kernel ends all others in it.
[[noreturn]] void run_inside(const std::function<std::string()>& run, const Descriptor& pipe) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::string obstacle = make_own_folders();
    (void)write_all(pipe, obstacle.empty() ? kResult + run() : kError + obstacle);
    _exit(0);
}

/// The process outside, which waits for the first one inside.
[[noreturn]] void run_keeper(const std::function<std::string()>& run, Descriptor pipe, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) { _exit(0); }  // the parent died before prctl took effect
    if (unshare(CLONE_NEWNET | CLONE_NEWNS | CLONE_NEWPID) != 0) {
        (void)write_all(pipe, kError + why("cannot create namespaces"));
        _exit(0);
    }
    const pid_t first = fork();
    if (first == 0) { run_inside(run, pipe); }
    if (first < 0) { (void)write_all(pipe, kError + why("cannot start a process")); }
    pipe = Descriptor();
    int status = 0;
    waitpid(first, &status, 0);
    _exit(0);
}

}  // namespace

std::filesystem::path sandbox_folder() { return "/dev/shm/scenario"; }

std::expected<Sandbox, std::string> Sandbox::start(const std::function<std::string()>& run) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) { return std::unexpected(why("cannot create a pipe")); }
    Descriptor output(ends[0]);
    Descriptor input(ends[1]);
    const pid_t self = getpid();
    const pid_t keeper = fork();
    if (keeper == 0) {
        output = Descriptor();
        run_keeper(run, std::move(input), self);
    }
    if (keeper < 0) { return std::unexpected(why("cannot start a process")); }
    return Sandbox(keeper, std::move(output));
}

/// Waits until the last process of the sandbox has closed the pipe's other end.
Sandbox::~Sandbox() {
    if (!pipe_.is_open()) { return; }
    kill(keeper_, SIGKILL);
    while (!read_output()) {}
    waitpid(keeper_, nullptr, 0);
}

bool Sandbox::read_output() {
    std::array<char, 4096> buffer{};
    const ssize_t n = ended_ ? 0 : read(pipe_.get(), buffer.data(), buffer.size());
    if (n > 0) { output_.append(buffer.data(), static_cast<std::size_t>(n)); }
    ended_ = n == 0 || (n < 0 && errno != EINTR);
    return ended_;
}

std::expected<std::string, std::string> Sandbox::result() const {
    if (output_.empty()) { return std::unexpected("the process that ran it was killed or crashed"); }
    if (output_.front() == kError) { return std::unexpected(output_.substr(1)); }
    return output_.substr(1);
}

}  // namespace lockstep::scenario
