#include "clients/scenario/runner/world.hpp"

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

constexpr char kResult = '+';  // what comes first out of a world
constexpr char kError = '-';

std::string why(const std::string& what) {
    return what + ": " + std::strerror(errno) + "; a scenario is played in namespaces of its own, which root may make";
}

void write_all(int pipe, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t n = write(pipe, text.data() + done, text.size() - done);
        if (n < 0 && errno == EINTR) { continue; }
        if (n <= 0) { return; }
        done += static_cast<std::size_t>(n);
    }
}

/// Memory in place of what is on the host. Empty: done; else why not.
std::string make_own_folders() {
    if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) { return why("cannot keep mounts apart"); }
    if (mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr) != 0) {
        return why("cannot mount /proc");
    }
    for (const char* path : {"/dev/shm", "/run"}) {  // /run: names of networks, the firewall's lock
        if (mount("tmpfs", path, "tmpfs", MS_NOSUID | MS_NODEV, nullptr) != 0) {
            return why("cannot mount " + std::string(path));
        }
    }
    std::error_code error;
    std::filesystem::create_directories(world_folder(), error);
    return error ? "cannot make " + world_folder().string() + ": " + error.message() : "";
}

/// The first process of the world: when it ends, the kernel ends all others in it.
[[noreturn]] void be_first(const std::function<std::string()>& play, int pipe) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::string obstacle = make_own_folders();
    write_all(pipe, obstacle.empty() ? kResult + play() : kError + obstacle);
    _exit(0);
}

/// The process outside, which waits for the first one inside.
[[noreturn]] void be_keeper(const std::function<std::string()>& play, int pipe, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) { _exit(0); }  // it died before that took effect
    if (unshare(CLONE_NEWNET | CLONE_NEWNS | CLONE_NEWPID) != 0) {
        write_all(pipe, kError + why("cannot make namespaces"));
        _exit(0);
    }
    const pid_t first = fork();
    if (first == 0) { be_first(play, pipe); }
    if (first < 0) { write_all(pipe, kError + why("cannot start a process")); }
    close(pipe);
    int status = 0;
    waitpid(first, &status, 0);
    _exit(0);
}

}  // namespace

std::filesystem::path world_folder() { return "/dev/shm/scenario"; }

std::expected<World, std::string> World::begin(const std::function<std::string()>& play) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) { return std::unexpected(why("cannot make a pipe")); }
    const pid_t self = getpid();
    const pid_t keeper = fork();
    if (keeper == 0) {
        close(ends[0]);
        be_keeper(play, ends[1], self);
    }
    close(ends[1]);
    if (keeper < 0) {
        close(ends[0]);
        return std::unexpected(why("cannot start a process"));
    }
    return World(keeper, ends[0]);
}

World::World(World&& other) noexcept
    : keeper_(std::exchange(other.keeper_, 0)),
      pipe_(std::exchange(other.pipe_, -1)),
      said_(std::move(other.said_)),
      ended_(other.ended_) {}

/// The pipe's other end is closed by the world's last process.
World::~World() {
    if (pipe_ < 0) { return; }
    kill(keeper_, SIGKILL);
    while (!take()) {}
    waitpid(keeper_, nullptr, 0);
    close(pipe_);
}

bool World::take() {
    std::array<char, 4096> buffer{};
    const ssize_t n = ended_ ? 0 : read(pipe_, buffer.data(), buffer.size());
    if (n > 0) { said_.append(buffer.data(), static_cast<std::size_t>(n)); }
    ended_ = n == 0 || (n < 0 && errno != EINTR);
    return ended_;
}

std::expected<std::string, std::string> World::result() const {
    if (said_.empty()) { return std::unexpected("what was playing it was ended from outside, or crashed"); }
    if (said_.front() == kError) { return std::unexpected(said_.substr(1)); }
    return said_.substr(1);
}

}  // namespace lockstep::scenario
