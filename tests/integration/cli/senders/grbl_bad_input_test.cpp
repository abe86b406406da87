// Senders that break the protocol while the machine moves. The motion is as planned, and the next sender is served.
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "tests/integration/cli/senders/grbl_machine.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

class BrokenSender : public GrblSender {
protected:
    void SetUp() override {
        GrblSender::SetUp();
        record();
        ASSERT_EQ(run_lockstep({"home"}).code, 0);
    }
    void configure(MachineSetup& machine) override { machine.unassigned.spindle = WordRule::Ignore; }
    static Sender ready() {
        Sender sender = connected();
        EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
        return sender;
    }
    /// `rows` rows of 100 mm, up and down, at 50 mm/s: 2 s each.
    static void begin_rows(Sender& sender, int rows) {
        for (int row = 0; row < rows; ++row) {
            for (int i = 0; i < 10; ++i) {
                const int x = 20 + 10 * (row % 2 == 0 ? i + 1 : 9 - i);
                ASSERT_TRUE(sender.answers("G1 X" + std::to_string(x) + " Y" + std::to_string(row) + " F3000", "ok"));
            }
        }
        EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Run"); }));
    }
    /// The sender is still served, and the machine runs all its lines.
    void goes_on(Sender& sender, int x_mm) {
        EXPECT_TRUE(sender.answers("G1 X" + std::to_string(x_mm) + " F3000", "ok"));
        rests_at(x_mm);
        expect_verified();
    }
    void rests_at(int x_mm) {
        EXPECT_TRUE(eventually([&] { return steps_of_x() == x_mm * 80 && status().phase() == "Idle"; }));
    }
};

TEST_F(BrokenSender, ThatFloodsTheMachineWithQuestionsDoesNotDisturbItsMotion) {
    Sender sender = ready();
    begin_rows(sender, 4);
    const auto begin = std::chrono::steady_clock::now();
    int questions = 0;
    while (std::chrono::steady_clock::now() - begin < 4s) {
        sender.send(std::string(100, '?'));
        questions += 100;
        std::this_thread::sleep_until(begin + questions * 100us);
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    std::cout << questions / took.count() << " questions a second\n";
    sender.forget();
    EXPECT_TRUE(sender.answers("$G", "[GC:G1 "));
    rests_at(20);
    expect_verified();
}

TEST_F(BrokenSender, BesideAnotherDoesNotDisturbItsMotion) {
    Sender sender = ready();
    begin_rows(sender, 3);
    for (int i = 0; i < 20; ++i) {
        auto second = Sender::over_tcp();
        ASSERT_TRUE(second);
        EXPECT_TRUE(second->receives("another sender is connected"));
    }
    goes_on(sender, 30);
}

TEST_F(BrokenSender, ThatSendsNothingKeepsNoOtherOut) {
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    std::vector<Sender> silent;
    for (int i = 0; i < 200; ++i) {
        silent.push_back(connected());
        if (i % 50 > 0) { continue; }
        Sender sender = connected();
        EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); })) << "beside " << i + 1;
    }
}

TEST_F(BrokenSender, ThatFallsSilentGivesWayToAnother) {
    Sender silent = ready();
    {
        auto second = Sender::over_tcp();
        ASSERT_TRUE(second);
        EXPECT_TRUE(second->receives("another sender is connected"));
    }
    std::this_thread::sleep_for(31s);
    Sender second = connected();
    EXPECT_TRUE(eventually([&] { return second.status().starts_with("Idle"); }));
    EXPECT_TRUE(silent.receives("another sender has connected while this one was silent"));
}

TEST_F(BrokenSender, ThatSendsAMegabyteInOneLineDoesNotDisturbItsMotion) {
    Sender sender = ready();
    begin_rows(sender, 3);
    sender.send(std::string(1'000'000, 'X') + "\n");
    EXPECT_TRUE(sender.receives("error:11"));
    goes_on(sender, 40);
}

TEST_F(BrokenSender, ThatDiesInTheMiddleOfALineLeavesItsWholeLines) {
    {
        Sender sender = ready();
        begin_rows(sender, 2);
        sender.send("G1 X25 Y");
    }
    rests_at(20);
    Sender next = ready();
    goes_on(next, 35);
}

TEST_F(BrokenSender, ThatDiesHasTheSpindleSwitchedOffBehindItsMotion) {
    {
        Sender sender = ready();
        ASSERT_TRUE(sender.answers("M3 S800", "ok"));
        begin_rows(sender, 2);
        EXPECT_TRUE(eventually([&] { return status().devices().has_spindle(); }));
    }
    rests_at(20);
    EXPECT_TRUE(eventually([&] { return !status().has_devices(); }));
}

/// Drops every packet from and to a sender, as if its cable were unplugged.
void unplug(const Sender& sender) {
    for (const std::string end : {"--sport ", "--dport "}) {
        const std::string packets = "-p tcp " + end + std::to_string(sender.port());
        ASSERT_EQ(std::system(("iptables -A INPUT " + packets + " -j DROP").c_str()), 0);
    }
}

TEST_F(BrokenSender, WhoseHostIsGoneLeavesTheMachineToTheNext) {
    if (geteuid() != 0) { GTEST_SKIP() << "to drop packets needs root"; }
    Sender lost = ready();
    ASSERT_TRUE(lost.answers("G1 X25 F3000", "ok"));
    rests_at(25);
    unplug(lost);
    std::optional<Sender> next = Sender::over_tcp();
    ASSERT_TRUE(next && !next->is_served());
    ASSERT_TRUE(eventually([&] {
        next.emplace(*Sender::over_tcp());
        return next->is_served();
    }));
    goes_on(*next, 35);
}

TEST_F(BrokenSender, OfGarbageIsServedAgainAfterAReset) {
    Sender sender = ready();
    begin_rows(sender, 2);
    std::string garbage;
    for (int i = 0; i < 200'000; ++i) { garbage += static_cast<char>((i * 7919) >> 3); }
    sender.send(garbage);
    sender.send("\x18");
    EXPECT_TRUE(sender.receives("Grbl 1.1h"));
    EXPECT_TRUE(sender.answers("$X", "ok"));
    EXPECT_TRUE(eventually([&] { return sender.status().starts_with("Idle"); }));
    sender.forget();
    EXPECT_TRUE(sender.answers("G21 G90 G94 G1 X45 F3000", "ok"));
    rests_at(45);
    expect_verified();
}

}  // namespace
}  // namespace lockstep
