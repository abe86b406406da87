// A service's notifications to systemd, read from systemd's socket.
#include "services/runtime/service_manager.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <string>

namespace lockstep {
namespace {

using namespace std::chrono_literals;

class NotifiesSystemd : public testing::Test {
protected:
    void SetUp() override {
        sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
        std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
        ASSERT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        ::setenv("NOTIFY_SOCKET", path_.c_str(), 1);
        ::setenv("WATCHDOG_USEC", "4000000", 1);
    }
    void TearDown() override {
        for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC"}) { ::unsetenv(name); }
        ::close(socket_);
        ::unlink(path_.c_str());
    }
    /// The next message, or an empty string if there is none.
    std::string notification() const {
        std::array<char, 256> text{};
        const ssize_t length = ::recv(socket_, text.data(), text.size(), MSG_DONTWAIT);
        return length < 0 ? "" : std::string(text.data(), static_cast<std::size_t>(length));
    }

private:
    std::string path_ = testing::TempDir() + "lockstep-notify-" + std::to_string(::getpid());
    int socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

TEST_F(NotifiesSystemd, ThatItIsUpAndThatItEnds) {
    const ServiceManager manager;
    manager.ready("axis X of machine mill");
    EXPECT_EQ(notification(), "READY=1\nSTATUS=axis X of machine mill");
    manager.stopping();
    EXPECT_EQ(notification(), "STOPPING=1");
}

TEST_F(NotifiesSystemd, ThatItIsAliveFourTimesInTheTimeTheWatchdogWaits) {
    ServiceManager manager;
    int times = 0;
    for (auto now = 10s + 0ms; now < 14s; now += 5ms) {
        manager.alive(now);
        for (; notification() == "WATCHDOG=1"; ++times) {}
    }
    EXPECT_EQ(times, 4);
}

TEST_F(NotifiesSystemd, NothingFromAServiceThatItDidNotStart) {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    ServiceManager manager;
    manager.ready("axis X");
    manager.alive(1s);
    manager.stopping();
    EXPECT_EQ(notification(), "");
}

}  // namespace
}  // namespace lockstep
