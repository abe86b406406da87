// Replayed messages have no effect: packets are captured while the machine moves, and sent again.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/integration/security/packet_tap.hpp"
#include "tests/integration/security/secured_machine.hpp"

namespace lockstep {
namespace {

class Replayed : public SecuredMachine {
protected:
    void expect_at(double x_mm, std::uint64_t job) const {
        const proto::StatusReport report = status();
        EXPECT_EQ(report.phase(), "Idle");
        EXPECT_FALSE(report.has_fault());
        EXPECT_EQ(report.job(), job);
        EXPECT_EQ(report.axes(0).position_mm(), x_mm);
    }
};

TEST_F(Replayed, PacketsThatAreSentAgainMoveNothing) {
    PacketTap tap;
    ASSERT_TRUE(tap.works()) << "raw sockets need root";
    ASSERT_EQ(run_lockstep({"move", "--relative", "X=10"}).code, 0);
    ASSERT_GT(tap.stop().size(), 100U);
    expect_at(11, 2);

    EXPECT_EQ(tap.send_again(), tap.stop().size());
    expect_at(11, 2);

    ASSERT_EQ(run_lockstep({"down"}).code, 0);
    bring_up_and_home();
    EXPECT_EQ(tap.send_again(), tap.stop().size());
    expect_at(1, 1);
    EXPECT_EQ(run_lockstep({"move", "X=5"}).code, 0) << "and the machine is not affected";
}

/// The program's name is sent from the command to the coordinator.
std::size_t packets_with(const std::vector<std::string>& packets, const std::string& secret) {
    return static_cast<std::size_t>(std::ranges::count_if(
        packets, [&](const std::string& packet) { return packet.contains("RTPS") && packet.contains(secret); }));
}

TEST_F(Replayed, MessagesCannotBeReadOnTheWire) {
    PacketTap tap;
    ASSERT_TRUE(tap.works());
    ASSERT_EQ(run_lockstep({"run", write("private_program.gcode", "G21 G90\nG1 X5 F600\nM2\n")}).code, 0);
    EXPECT_EQ(packets_with(tap.stop(), "private_program"), 0U);
}

class Unsecured : public OwnMachine {};

TEST_F(Unsecured, MessagesCanBeReadOnTheWire) {
    bring_up_and_home();
    PacketTap tap;
    ASSERT_TRUE(tap.works());
    ASSERT_EQ(run_lockstep({"run", write("private_program.gcode", "G21 G90\nG1 X5 F600\nM2\n")}).code, 0);
    EXPECT_GT(packets_with(tap.stop(), "private_program"), 0U) << "so the test above would have detected it";
}

}  // namespace
}  // namespace lockstep
