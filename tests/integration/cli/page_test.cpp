// The page of a machine: `lockstep up` starts it, its supervisor restarts it, and the machine works without it.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>

#include "services/files/text_file.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A TCP socket of loopback.
class Socket {
public:
    Socket() : file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    ~Socket() { close(file_); }

    /// Listens at a port; at any free one if it is 0. Returns the port.
    std::uint16_t listen_at(std::uint16_t port = 0) const {
        sockaddr_in address = at(port);
        socklen_t size = sizeof address;
        EXPECT_EQ(bind(file_, std::bit_cast<sockaddr*>(&address), size), 0);
        EXPECT_EQ(listen(file_, 1), 0);
        EXPECT_EQ(getsockname(file_, std::bit_cast<sockaddr*>(&address), &size), 0);
        return ntohs(address.sin_port);
    }
    /// The begin of a server's answer; empty if nothing listens.
    std::string ask(std::uint16_t port) const {
        sockaddr_in address = at(port);
        constexpr std::string_view kRequest = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
        std::string answer(12, '\0');
        if (connect(file_, std::bit_cast<sockaddr*>(&address), sizeof address) != 0) { return ""; }
        if (send(file_, kRequest.data(), kRequest.size(), MSG_NOSIGNAL) < 0) { return ""; }
        answer.resize(static_cast<std::size_t>(std::max<ssize_t>(0, recv(file_, answer.data(), 12, MSG_WAITALL))));
        return answer;
    }

private:
    static sockaddr_in at(std::uint16_t port) {
        return {.sin_family = AF_INET, .sin_port = htons(port), .sin_addr = {htonl(INADDR_LOOPBACK)}, .sin_zero = {}};
    }
    int file_;
};

class PageOfAMachine : public OwnMachine {
protected:
    void configure(MachineSetup& machine) override {
        port_ = Socket().listen_at();
        machine.web = WebConfig{.port = port_};
    }
    bool is_served() const { return Socket().ask(port_) == "HTTP/1.1 200"; }
    std::filesystem::path page_file() const { return state().page_file(); }

    std::uint16_t port_ = 0;
};

TEST_F(PageOfAMachine, IsServedWithoutItsTokenInALogAndStartedAgain) {
    const Ran up = run_lockstep({"up"});
    ASSERT_EQ(up.code, 0) << up.out << up.err;
    const std::string address = "http://127.0.0.1:" + std::to_string(port_) + "/";
    EXPECT_THAT(up.out, AllOf(HasSubstr("is up"), ContainsRegex(address + "#token=[0-9a-f]+\n")));
    EXPECT_TRUE(is_served());
    struct stat mode {};
    ASSERT_EQ(stat(page_file().c_str(), &mode), 0);
    EXPECT_EQ(mode.st_mode & 0777, S_IRUSR | S_IWUSR);
    EXPECT_THAT(text_of_log("web"), AllOf(HasSubstr(address), Not(HasSubstr("token="))));

    const pid_t before = process("web");
    kill(before, SIGKILL);
    ASSERT_TRUE(eventually([&] { return process("web") != 0 && process("web") != before && is_served(); }));
    EXPECT_EQ(status().phase(), "Idle");
    EXPECT_EQ(run_lockstep({"down"}).code, 0);
    EXPECT_FALSE(is_served());
    EXPECT_FALSE(std::filesystem::exists(page_file()));
}

TEST_F(PageOfAMachine, ThatCannotBeServedLeavesTheMachineUp) {
    const Socket other;
    other.listen_at(port_);
    const Ran up = run_lockstep({"up", "--web"});
    EXPECT_EQ(up.code, 0) << up.out << up.err;
    EXPECT_THAT(up.err, AllOf(HasSubstr("the page is not served"), HasSubstr("choose another port: --port N")));
    EXPECT_EQ(status().phase(), "Idle");
}

}  // namespace
}  // namespace lockstep
