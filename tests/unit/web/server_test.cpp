// The server over real sockets: what reaches the machine of requests that can be read in more than one way, and of many
// connections that send nothing.
#include "clients/web/http/server.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <random>
#include <thread>

#include "clients/channel/bytes.hpp"
#include "clients/web/api/api.hpp"
#include "tests/unit/web/noting_port.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr auto kPatience = 20s;  // for an answer, on a busy host

std::string number_of(CommandKind kind) { return "command " + std::to_string(static_cast<int>(kind)); }

class OverSockets : public testing::Test {
protected:
    static Listener listening() {
        auto listener = listen_at("127.0.0.1", 0);
        EXPECT_TRUE(listener);
        return *listener;
    }

    /// A connection from the address 127.0.0.`host`.
    Descriptor connected(std::uint8_t host = 1) const {
        Descriptor made(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
        sockaddr_in from{.sin_family = AF_INET, .sin_addr = {htonl(0x7F000000U + host)}};
        EXPECT_EQ(bind(made.get(), std::bit_cast<const sockaddr*>(&from), sizeof from), 0);
        const sockaddr_in to{
            .sin_family = AF_INET, .sin_port = htons(listener.port), .sin_addr = {htonl(INADDR_LOOPBACK)}};
        EXPECT_EQ(connect(made.get(), std::bit_cast<const sockaddr*>(&to), sizeof to), 0);
        return made;
    }
    static void send_to(const Descriptor& connection, const std::string& bytes) {
        (void)send(connection.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }
    /// The server has neither sent anything nor closed the connection.
    static bool is_open(const Descriptor& connection) { return wait_for(connection.get(), POLLIN, 0) == 0; }
    /// Everything that comes until the server closes the connection.
    static std::string all_of(const Descriptor& connection) {
        std::string text;
        const auto end = std::chrono::steady_clock::now() + kPatience;
        while (std::chrono::steady_clock::now() < end) {
            const auto more = read_from(connection, 100ms);
            if (!more) { return text; }
            text += *more;
        }
        ADD_FAILURE() << "the connection is still open after " << text;
        return text;
    }
    std::string answer_to(const std::string& bytes, std::uint8_t host = 1) const {
        const Descriptor connection = connected(host);
        send_to(connection, bytes);
        return all_of(connection);
    }
    std::vector<std::string> asked() {
        const std::lock_guard lock(port.mutex);
        return std::exchange(port.asked, {});
    }

    MachineSetup machine = two_axes();
    NotingPort port;
    EventLog log{"run"};
    ProgramDesk desk;
    ReportFiles reports{"/nonexistent/a", "/nonexistent/b"};
    Api api{{machine, port, log, desk, reports, {}, "1.0"},
            {.tokens = {.view = "view-token-0123456", .operate = "operate-token-0123"}, .hosts = {"localhost"}}};
    Listener listener = listening();
    std::unique_ptr<Server> server = *Server::start(listener, {}, api);
    std::jthread waking{[this](const std::stop_token& stop) {  // as the machine's thread does it
        while (!stop.stop_requested()) {
            server->wake_streams();
            std::this_thread::sleep_for(50ms);
        }
    }};
};

const std::string kToken = "Authorization: Bearer operate-token-0123";
const std::string kJson = "Content-Type: application/json\r\n";

/// The last request of a connection, so that its answer ends with the connection.
std::string last_request(const std::string& verb) {
    return "POST /api/commands/" + verb + " HTTP/1.1\r\nHost: localhost\r\n" + kToken +
           "\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
}

TEST_F(OverSockets, ManyConnectionsThatSendNothingDoNotKeepAStopOut) {
    std::vector<Descriptor> silent;
    for (int i = 0; i < 700; ++i) {
        silent.push_back(connected(i % 2 == 0 ? 1 : 2));
        if (i % 3 == 0) { send_to(silent.back(), "POST /api/commands/run HTTP/1.1\r\nHost: loc"); }
        if (i % 3 == 1) {
            send_to(silent.back(),
                    "POST /api/commands/run HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100\r\n\r\n{");
        }
    }
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_THAT(answer_to(last_request("stop")), StartsWith("HTTP/1.1 200"));
    EXPECT_THAT(answer_to(last_request("estop"), 3), StartsWith("HTTP/1.1 200"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 5s);
    EXPECT_THAT(asked(), ElementsAre(number_of(CommandKind::Stop), number_of(CommandKind::EmergencyStop)));
    EXPECT_LE(static_cast<std::size_t>(std::ranges::count_if(silent, is_open)), ConnectionLimits::kMostUnknown);
}

TEST_F(OverSockets, AnswersClientsOfAllSortsThatAreClear) {
    const std::string stop = "POST /api/commands/stop HTTP/1.1\r\nHost:localhost\r\n" + kJson + kToken + "\r\n";
    EXPECT_THAT(
        answer_to(stop + "Transfer-Encoding: chunked\r\n\r\n2;x=y\r\n{}\r\n0\r\nX: y\r\n\r\n" + last_request("hold")),
        AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("\r\n\r\n{\"accepted\":true,\"job\":null}\nHTTP/1.1 200")));
    EXPECT_THAT(asked(), ElementsAre(number_of(CommandKind::Stop), number_of(CommandKind::Hold)))
        << "requests behind each other on one connection";
    EXPECT_THAT(answer_to("POST /api/commands/stop HTTP/1.0\r\nHost: localhost\r\n" + kJson + kToken +
                          "\r\nContent-Length: 2\r\n\r\n{}"),
                HasSubstr(" 200 "));
    EXPECT_THAT(asked(), ElementsAre(number_of(CommandKind::Stop)));
}

TEST_F(OverSockets, EndsAConnectionThatSendsOrReadsTooSlowly) {
    const std::string stop = "POST /api/commands/stop HTTP/1.1\r\nHost: localhost\r\n" + kJson;
    std::vector<Descriptor> slow;
    for (const std::string& begin :
         {std::string(), "POST /api/comm" + std::string(), stop, stop + "Content-Length: 100\r\n\r\n{",
          stop + kToken + "\r\nContent-Length: 100\r\n\r\n{",
          stop + "Transfer-Encoding: chunked\r\n\r\nffffffffffffffff\r\n{"}) {
        slow.push_back(connected());
        send_to(slow.back(), begin);
    }
    const auto begin = std::chrono::steady_clock::now();
    while (std::ranges::any_of(slow, is_open) && std::chrono::steady_clock::now() - begin < 2 * kPatience) {
        for (std::size_t i = 1; i < slow.size(); ++i) {
            if (is_open(slow[i])) { send_to(slow[i], " "); }
        }
        std::this_thread::sleep_for(200ms);
    }
    EXPECT_TRUE(std::ranges::none_of(slow, is_open));
    EXPECT_GE(std::chrono::steady_clock::now() - begin, ConnectionLimits::kPatience - 1s) << "each has its time";
    EXPECT_THAT(asked(), IsEmpty());
}

TEST_F(OverSockets, RefusesChunksThatAreNone) {
    for (const char* body : {"x\r\n{}\r\n0\r\n\r\n", "-2\r\n{}\r\n0\r\n\r\n", "10000000000000002\r\n{}\r\n0\r\n\r\n",
                             "2\r\n{}0\r\n\r\n", "ffffffffffffffff\r\n{}\r\n0\r\n\r\n", "2{}\r\n0\r\n\r\n"}) {
        SCOPED_TRACE(body);
        const Descriptor connection = connected();
        send_to(connection, "POST /api/commands/stop HTTP/1.1\r\nHost: localhost\r\n" + kJson + kToken +
                                "\r\nTransfer-Encoding: chunked\r\n\r\n" + body);
        shutdown(connection.get(), SHUT_WR);
        EXPECT_THAT(all_of(connection), Not(HasSubstr(" 200 "))) << body;
        EXPECT_THAT(asked(), IsEmpty()) << body;
    }
}

TEST_F(OverSockets, BoundsTheHead) {
    std::string many;
    for (int i = 0; i < 100'000; ++i) { many += "X-" + std::to_string(i) + ": y\r\n"; }
    for (const std::string& head : {many, "X: " + std::string(1'000'000, 'x') + "\r\n"}) {
        const Descriptor connection = connected();
        send_to(connection,
                "POST /api/commands/stop HTTP/1.1\r\nHost: localhost\r\n" + kToken + "\r\n" + head + "\r\n");
        EXPECT_THAT(all_of(connection), Not(HasSubstr(" 200 ")));
    }
    EXPECT_THAT(answer_to("GET /" + std::string(1'000'000, 'a') + " HTTP/1.1\r\nHost: localhost\r\n\r\n"),
                Not(HasSubstr(" 200 ")));
    EXPECT_THAT(asked(), IsEmpty());
}

/// Builds a request out of lines that are clear, and perhaps one that is not. Its body looks like an emergency stop.
class RandomRequest {
public:
    explicit RandomRequest(std::uint64_t seed) : random_(seed) {
        lines_ = {"Host: localhost", kToken, "Content-Length: " + std::to_string(body_.size())};
        const std::vector<std::string> clear{"X-A: b",        "Accept: */*", "Accept: text/html", "Cookie: a=b",
                                             "User-Agent: x", "X-Empty:",    "x-lower:  spaces "};
        for (std::size_t i = below(4); i > 0; --i) { lines_.push_back(one_of(clear)); }
        std::ranges::sort(lines_);
        lines_.erase(std::ranges::unique(lines_).begin(), lines_.end());
        is_clear_ = below(4) == 0;
        if (!is_clear_) { lines_.push_back(unclear()); }
        std::ranges::shuffle(lines_, random_);
    }
    std::string text() {
        std::string text = request_line_ + "\r\n";
        for (const std::string& line : lines_) { text += line + "\r\n"; }
        return text + "\r\n" + body_;
    }
    bool is_clear() const { return is_clear_; }

private:
    std::size_t below(std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most - 1)(random_); }
    const std::string& one_of(const std::vector<std::string>& from) { return from[below(from.size())]; }
    std::string unclear() {
        if (below(4) == 0) {
            request_line_ =
                one_of({"POST http://localhost/api/commands/stop HTTP/1.1", "POST * HTTP/1.1",
                        "POST /api/commands/stop%00 HTTP/1.1", "POST /api/commands/stop HTTP/1.2",
                        "POST /api/commands/stop%0d%0aX: HTTP/1.1", "POST /api/commands/st%6Fp#x HTTP/1.1"});
            return "X-B: c";
        }
        return one_of({"Host: evil.example",
                       "host: localhost",
                       "Content-Length: 0",
                       "Content-Length: 1000",
                       "CONTENT-LENGTH: " + std::to_string(body_.size()),
                       "Transfer-Encoding: chunked",
                       "Transfer-Encoding: identity",
                       "Transfer-Encoding:\r\n chunked",
                       "transfer-encoding: x",
                       "Authorization: Bearer operate-token-0123",
                       "X\x01: a",
                       "X: a\x01",
                       "X Y: a",
                       "X : a",
                       "Origin: http://localhost\r\nOrigin: http://localhost",
                       "Content-Length: +0",
                       "Content-Length:\r\n 0",
                       "X-C: y\r\n folded",
                       "X-C: y\n",
                       "X-C: y\nX-D: z",
                       "X-C: y\rX-D: z",
                       std::string("X-C: y\0z", 8),
                       std::string("Transfer-Encoding: \0chunked", 27),
                       "X-C: y\r",
                       "X-C"});
    }

    std::mt19937_64 random_;
    std::string request_line_ = "POST /api/commands/stop HTTP/1.1";
    std::string body_ = "{}" + std::string(100, ' ') + "\r\n\r\n0\r\n\r\n";
    std::vector<std::string> lines_;
    bool is_clear_ = false;
};

TEST_F(OverSockets, OnlyARequestThatCanBeReadInOneWayReachesTheMachine) {
    std::size_t answered = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        RandomRequest request(seed);
        const std::string text = request.text();
        const Descriptor connection = connected();
        send_to(connection, text + last_request("estop"));
        const std::string answer = all_of(connection);
        const auto done = asked();
        if (request.is_clear()) {
            // the body is not JSON
            EXPECT_THAT(answer, StartsWith("HTTP/1.1 4")) << seed << text;
            EXPECT_THAT(done, ElementsAre(number_of(CommandKind::EmergencyStop))) << seed << text << answer;
        } else {
            EXPECT_THAT(answer, AnyOf(StartsWith("HTTP/1.1 4"), StartsWith("HTTP/1.1 505"), "")) << seed << text;
            answered += answer.empty() ? 0 : 1;
            EXPECT_THAT(done, IsEmpty()) << seed << text << answer;
        }
    }
    EXPECT_GT(answered, 100U) << "a refusal has a text";
}

}  // namespace
}  // namespace lockstep::web
