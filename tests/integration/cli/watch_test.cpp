// lockstep watch with a live machine: on a terminal, and without one.
#include <gmock/gmock.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::EndsWith;

using Watch = OwnMachine;

/// A terminal of 80 columns with a command; it ends with the object.
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
    void type(char key) { ASSERT_EQ(write(master_, &key, 1), 1); }
    bool echoes() const {
        termios mode{};
        tcgetattr(master_, &mode);
        return (mode.c_lflag & ECHO) != 0;
    }
    int wait() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

private:
    int master_ = -1;
    pid_t pid_ = 0;
    std::string text_;
};

constexpr const char* kScreenBefore = "\x1b[?7h\x1b[?25h\x1b[?1049l";

TEST_F(Watch, ShowsALiveMachineAndGivesTheTerminalBack) {
    bring_up();
    for (const char key : {'q', '\x03'}) {
        Terminal terminal("watch");
        ASSERT_TRUE(terminal.shows("setpoint slack")) << terminal.text();
        EXPECT_FALSE(terminal.echoes());
        terminal.type(key);
        EXPECT_EQ(terminal.wait(), 0);
        EXPECT_THAT(terminal.text(), EndsWith(kScreenBefore));
        EXPECT_TRUE(terminal.echoes());
    }
}

TEST_F(Watch, WithoutATerminalWritesLines) {
    bring_up();
    Command watch(LOCKSTEP_COMMAND, {"watch"});
    EXPECT_TRUE(
        eventually([&] { return watch.out().find(": Idle; X not homed; Y not homed\n") != std::string::npos; }));
    watch.signal(SIGINT);
    const Ran ran = watch.wait();
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out.find('\x1b'), std::string::npos);
}

/// An axis's figures after a move: every step compared with the plan, every frame in time.
TEST_F(Watch, LiveFiguresAreInTheStatus) {
    bring_up_and_home();
    Command move(LOCKSTEP_COMMAND, {"move", "X=60", "Y=20", "--feed", "1200"});
    proto::HealthReport seen;
    EXPECT_TRUE(eventually([&] {
        seen = status().axes(0).health();
        return seen.has_setpoint_slack_ms() && seen.has_step_lateness_us();
    }));
    EXPECT_EQ(move.wait().code, 0);
    EXPECT_EQ(seen.step_lateness_us().min(), 0);  // the device counts the machine's own clock
    EXPECT_EQ(seen.step_lateness_us().max(), 0);
    EXPECT_GT(seen.step_interval_us().min(), 0);
    EXPECT_GT(seen.setpoint_slack_ms().min(), 0);
    EXPECT_LE(seen.setpoint_slack_ms().max(), 780);  // sent ahead by 39 slots
    EXPECT_GT(seen.loop_max_us(), 0);
    EXPECT_GE(seen.loop_max_us(), seen.loop_p50_us());
    EXPECT_GT(seen.least_free_segments(), 0U);
    EXPECT_GT(seen.least_free_captures(), 0U);
    EXPECT_EQ(seen.lost_captures(), 0U);
}

}  // namespace
}  // namespace lockstep
