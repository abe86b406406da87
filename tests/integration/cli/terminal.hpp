// A command on a terminal of 80 columns; it ends with the object.
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/integration/wire/eventually.hpp"

namespace lockstep {

class Terminal {
public:
    explicit Terminal(const char* verb) {
        winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
        pid_ = forkpty(&master_, nullptr, nullptr, &size);
        if (pid_ != 0) { return; }
        execl(LOCKSTEP_COMMAND, "lockstep", verb, static_cast<char*>(nullptr));
        _exit(127);
    }
    ~Terminal() {
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
        close(master_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    /// Its whole output so far.
    const std::string& text() {
        pollfd ready{.fd = master_, .events = POLLIN, .revents = 0};
        char bytes[4096];
        while (poll(&ready, 1, 0) == 1) {
            const ssize_t count = read(master_, bytes, sizeof bytes);
            if (count <= 0) { break; }
            text_.append(bytes, static_cast<std::size_t>(count));
        }
        return text_;
    }
    bool shows(const std::string& what) {
        return eventually([&] { return text().find(what) != std::string::npos; });
    }
    void type(const std::string& keys) {
        ASSERT_EQ(write(master_, keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
    }
    /// Stops the command for a time that it cannot notice, and types meanwhile.
    void type_while_stopped(const std::string& keys, std::chrono::milliseconds time) {
        kill(pid_, SIGSTOP);
        type(keys);
        std::this_thread::sleep_for(time);
        kill(pid_, SIGCONT);
    }
    bool echoes() const {
        termios mode{};
        tcgetattr(master_, &mode);
        return (mode.c_lflag & ECHO) != 0;
    }
    /// Its exit code, or its signal, negative. Reads, because a command waits while nobody reads its output.
    int wait() {
        int status = 0;
        const auto ends = [&] {
            text();
            return waitpid(pid_, &status, WNOHANG) == pid_;
        };
        if (!eventually(ends)) {
            ADD_FAILURE() << "it does not end; its output is: " << text_;
            return -1;
        }
        pid_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

private:
    int master_ = -1;
    pid_t pid_ = 0;
    std::string text_;
};

}  // namespace lockstep
