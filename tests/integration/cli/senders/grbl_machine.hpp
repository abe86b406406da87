// A sender of grbl's protocol, byte by byte, at a machine of real processes.
#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <utility>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {

inline constexpr std::uint16_t kPort = 2399;

class Sender {
public:
    static std::optional<Sender> over_tcp() {
        const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_port = htons(kPort);
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (connect(fd, reinterpret_cast<sockaddr*>(&place), sizeof place) == 0) { return Sender(fd); }
        close(fd);
        return std::nullopt;
    }
    static std::optional<Sender> over_terminal(const std::string& path) {
        const int fd = open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        return fd < 0 ? std::nullopt : std::optional<Sender>(Sender(fd));
    }
    Sender(Sender&& other) noexcept : fd_(std::exchange(other.fd_, -1)), text_(std::move(other.text_)) {}
    ~Sender() {
        if (fd_ >= 0) { close(fd_); }
    }

    /// The TCP port of this end.
    std::uint16_t port() const {
        sockaddr_in place{};
        socklen_t size = sizeof place;
        EXPECT_EQ(getsockname(fd_, reinterpret_cast<sockaddr*>(&place), &size), 0);
        return ntohs(place.sin_port);
    }
    void send(const std::string& bytes) {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = write(fd_, bytes.data() + done, bytes.size() - done);
            ASSERT_GT(count, 0);
            done += static_cast<std::size_t>(count);
            read_all();
        }
    }
    /// Drops everything received so far.
    void forget() {
        read_all();
        text_.clear();
    }
    /// Reads until this text comes, and drops everything up to its end.
    bool receives(const std::string& what) {
        return eventually([&] {
            read_all();
            const std::size_t at = text_.find(what);
            if (at != std::string::npos) { text_.erase(0, at + what.size()); }
            return at != std::string::npos;
        });
    }
    /// Waits until it is greeted; false if the machine serves another sender.
    bool is_served() {
        bool is_greeted = false;
        EXPECT_TRUE(eventually([&] {
            read_all();
            is_greeted = text_.contains("Grbl 1.1h");
            return is_greeted || text_.contains("another sender is connected");
        }));
        return is_greeted;
    }
    bool answers(const std::string& line, const std::string& what) {
        send(line + "\n");
        return receives(what);
    }
    /// The next status report.
    std::string status() {
        send("?");
        if (!receives("<")) { return {}; }
        (void)eventually([&] {
            read_all();
            return text_.find('>') != std::string::npos;
        });
        return text_.substr(0, text_.find('>'));
    }

private:
    explicit Sender(int fd) : fd_(fd) {}
    void read_all() {
        pollfd ready{.fd = fd_, .events = POLLIN, .revents = 0};
        char bytes[4096];
        while (poll(&ready, 1, 0) == 1 && (ready.revents & POLLIN) != 0) {
            const ssize_t count = read(fd_, bytes, sizeof bytes);
            if (count <= 0) { return; }
            text_.append(bytes, static_cast<std::size_t>(count));
        }
    }

    int fd_;
    std::string text_;
};

class GrblSender : public OwnMachine {
protected:
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up();
        terminal_ = (folder() / "grbl").string();
        process_.emplace(LOCKSTEP_GRBL, Words{"--port", std::to_string(kPort), "--pty", terminal_});
    }
    void TearDown() override {
        process_->signal(SIGTERM);
        EXPECT_EQ(process_->wait().code, 0);
        OwnMachine::TearDown();
    }
    /// Connects again while the machine still serves a sender that has just left.
    static Sender connected() {
        std::optional<Sender> sender;
        EXPECT_TRUE(eventually([&] {
            auto opened = Sender::over_tcp();
            if (!opened) { return false; }
            sender.emplace(std::move(*opened));
            return sender->is_served();
        }));
        EXPECT_TRUE(sender->receives("Grbl 1.1h ['$' for help]"));
        return std::move(*sender);
    }
    std::int64_t steps_of_x() const { return status().axes(0).position_steps(); }

    std::string terminal_;
    std::optional<ChildProcess> process_;
};

}  // namespace lockstep
