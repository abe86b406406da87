// A sender of grbl's protocol and a machine of real processes: over TCP and over a pseudo-terminal.
#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/cli/terminal.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr std::uint16_t kPort = 2399;

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

    void send(const std::string& bytes) {
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = write(fd_, bytes.data() + done, bytes.size() - done);
            ASSERT_GT(count, 0);
            done += static_cast<std::size_t>(count);
            read_all();
        }
    }
    /// Reads until this comes; what came before it is forgotten.
    bool receives(const std::string& what) {
        return eventually([&] {
            read_all();
            const std::size_t at = text_.find(what);
            if (at != std::string::npos) { text_.erase(0, at + what.size()); }
            return at != std::string::npos;
        });
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
    static Sender connected() {
        std::optional<Sender> sender;
        EXPECT_TRUE(eventually([&] {
            if (auto opened = Sender::over_tcp()) { sender.emplace(std::move(*opened)); }
            return sender.has_value();
        }));
        EXPECT_TRUE(sender->receives("Grbl 1.1h ['$' for help]"));
        return std::move(*sender);
    }
    std::int64_t steps_of_x() const { return status().axes(0).position_steps(); }

    std::string terminal_;
    std::optional<Command> process_;
};

TEST_F(GrblSender, HomesJogsAndSetsTheWorkZero) {
    Sender sender = connected();
    EXPECT_THAT(sender.status(), HasSubstr("Alarm|"));
    EXPECT_TRUE(sender.answers("G0 X1", "error:9"));
    EXPECT_TRUE(sender.answers("$H", "ok"));
    EXPECT_TRUE(status().axes(1).homed());
    EXPECT_THAT(sender.status(), HasSubstr("Idle|MPos:"));
    const std::int64_t before = steps_of_x();
    EXPECT_TRUE(sender.answers("$J=G91 X10 F3000", "ok"));
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    EXPECT_EQ(steps_of_x(), before + 800);
    EXPECT_TRUE(sender.answers("G10 L20 P1 X0", "ok"));
    EXPECT_TRUE(sender.answers("$#", "[G54:" + std::to_string((before + 800) / 80)));
    EXPECT_TRUE(sender.answers("$J=X-2 F3000", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == before + 640 && status().phase() == "Idle"; }));
    EXPECT_TRUE(sender.answers("$J=X1000 F3000", "error:15"));
    EXPECT_TRUE(sender.answers("$100", "error:3"));
    EXPECT_TRUE(sender.answers("$$", "$100=80.000"));
    EXPECT_TRUE(sender.answers("G1 X0 F3000", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == before + 800 && status().phase() == "Idle"; }));
    sender.send("\x91");
    EXPECT_TRUE(eventually([&] { return status().feed_override_percent() == 110; }));
}

TEST_F(GrblSender, StreamsLinesHoldsResumesAndResets) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    for (int k = 0; k < 100; ++k) {
        ASSERT_TRUE(
            sender.answers("G1 X" + std::to_string(20 + k) + " Y" + std::to_string(20 + k % 2) + " F3000", "ok"));
    }
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Run"); }));
    sender.send("!");
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Hold:0"); }));
    EXPECT_EQ(status().phase(), "Holding");
    sender.send("~");
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 119 * 80 && status().phase() == "Idle"; }));
    ASSERT_TRUE(sender.answers("G0 X10", "ok"));
    EXPECT_TRUE(eventually([&] { return status().phase() == "Running" && steps_of_x() < 119 * 80; }));
    sender.send("\x18");
    EXPECT_TRUE(sender.receives("Grbl 1.1h"));
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    EXPECT_GT(steps_of_x(), 10 * 80);
    ASSERT_TRUE(sender.answers("G4 P0.1", "ok"));
    ASSERT_TRUE(sender.answers("G0 X30", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 30 * 80 && status().phase() == "Idle"; }));
}

TEST_F(GrblSender, LeavesAndItsJogBrakes) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    {
        Sender sender = connected();
        EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
        ASSERT_TRUE(sender.answers("$J=G91 X150 F600", "ok"));
        EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Jog"); }));
    }
    EXPECT_TRUE(becomes("Idle"));
    const std::int64_t rests_at = steps_of_x();
    EXPECT_LT(rests_at, 150 * 80);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    ASSERT_TRUE(sender.answers("$J=G91 X100 F600", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() > rests_at; }));
    sender.send("\x85");
    EXPECT_TRUE(becomes("Idle"));
    EXPECT_LT(steps_of_x(), 180 * 80);
}

TEST_F(GrblSender, HasTheMachineForItselfWhileItWorks) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    EXPECT_FALSE(status().has_writer()) << "it has asked for nothing yet";
    ASSERT_TRUE(sender.answers("$J=G91 X150 F600", "ok"));
    EXPECT_EQ(status().writer().name(), "the grbl sender at 127.0.0.1");
    const Ran refused = run_lockstep({"override", "--feed", "50"});
    EXPECT_EQ(refused.code, 1);
    EXPECT_THAT(refused.err, HasSubstr("the grbl sender at 127.0.0.1 on "));
    EXPECT_EQ(run_lockstep({"override", "--feed", "50", "--take"}).code, 0);
    EXPECT_TRUE(becomes("Idle"));
    EXPECT_LT(steps_of_x(), 150 * 80) << "the jog brakes";
}

TEST_F(GrblSender, IsRefusedWhileAnotherHasTheMachine) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    Sender sender = connected();
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    {
        Terminal jog("jog");
        ASSERT_TRUE(jog.shows("left, right"));
        EXPECT_TRUE(sender.answers("G0 X50", "has been the machine's writer for"));
        EXPECT_TRUE(sender.receives("error:9"));
        EXPECT_TRUE(sender.answers("$J=G91 X1 F600", "error:9"));
        EXPECT_TRUE(sender.answers("G10 L20 P1 X0", "error:9"));
        jog.type("q");
        EXPECT_EQ(jog.wait(), 0);
    }
    EXPECT_TRUE(sender.answers("G0 X50", "ok"));
    EXPECT_TRUE(eventually([&] { return steps_of_x() == 50 * 80 && status().phase() == "Idle"; }));
    EXPECT_TRUE(status().has_writer());
    EXPECT_TRUE(eventually([&] { return !status().has_writer(); })) << "it has rested for a while";
}

TEST_F(GrblSender, MayUseATerminalAndComeAgain) {
    ASSERT_TRUE(eventually([&] { return ::access(terminal_.c_str(), R_OK | W_OK) == 0; }));
    for (int i = 0; i < 2; ++i) {
        auto sender = Sender::over_terminal(terminal_);
        ASSERT_TRUE(sender);
        sender->send("\x18");  // one that comes back at once is not greeted by itself
        EXPECT_TRUE(sender->receives("Grbl 1.1h ['$' for help]")) << i;
        EXPECT_TRUE(sender->answers("$I", "[VER:1.1h."));
        EXPECT_TRUE(sender->receives("ok"));
        EXPECT_TRUE(eventually([&] { return sender->status().starts_with("Alarm|MPos:"); }));
    }
}

TEST_F(GrblSender, WritesSettingsThatAreInForceAfterARestart) {
    ASSERT_TRUE(eventually([&] { return ::access(terminal_.c_str(), R_OK | W_OK) == 0; }));
    auto sender = Sender::over_terminal(terminal_);
    ASSERT_TRUE(sender);
    EXPECT_TRUE(sender->answers("$110=3000", "[MSG:$110 is kept; in force when the machine is next brought up]"));
    EXPECT_TRUE(sender->receives("ok"));
    EXPECT_TRUE(sender->answers("$$", "$110=3000.000"));
    EXPECT_TRUE(sender->receives("[MSG:$110 in force when the machine is next brought up]"));
    EXPECT_TRUE(sender->answers("$110=1", "below start_velocity_mm_s 10"));
    EXPECT_TRUE(sender->receives("error:101"));
    EXPECT_TRUE(sender->answers("$0=5", "error:100"));
    EXPECT_EQ(run_lockstep({"down"}).code, 0);
    EXPECT_THAT(run_lockstep({"up"}).out, HasSubstr("X.max_velocity_mm_s: 50"));
    EXPECT_TRUE(sender->receives("Grbl 1.1h")) << "the machine is another";
    EXPECT_TRUE(sender->answers("$$", "$110=3000.000"));
    EXPECT_TRUE(sender->answers("$H", "ok"));
    EXPECT_TRUE(sender->answers("$RST=$", "ok"));
    EXPECT_TRUE(sender->answers("$$", "$110=9000.000"));
    EXPECT_EQ(run_lockstep({"config", "--json"}).json<proto::SettingsReport>().settings_size(), 0);
}

TEST_F(GrblSender, OfGarbageAFloodAndAMegabyteDoesNoHarm) {
    Sender sender = connected();
    std::string garbage;
    for (int i = 0; i < 20'000; ++i) { garbage += static_cast<char>((i * 7919) >> 3); }
    sender.send(garbage);
    sender.send(std::string(20'000, '?'));
    sender.send("\x18");
    EXPECT_TRUE(sender.receives("Grbl 1.1h"));
    sender.send(std::string(1'000'000, 'X') + "\n");
    EXPECT_TRUE(sender.receives("error:11"));
    EXPECT_TRUE(sender.answers("$G", "[GC:G0 G54 G17 G21 G90 G94"));
    auto second = Sender::over_tcp();
    ASSERT_TRUE(second);
    EXPECT_TRUE(second->receives("another sender is connected"));
    EXPECT_EQ(status().phase(), "Idle");
}

}  // namespace
}  // namespace lockstep
