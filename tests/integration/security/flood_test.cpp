// A machine without security recovers by itself after altered packets of its members were sent again.
#include <gtest/gtest.h>

#include <chrono>
#include <iostream>
#include <thread>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/security/packet_damage.hpp"
#include "tests/integration/security/packet_forger.hpp"
#include "tests/integration/security/packet_tap.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

class Flooded : public OwnMachine {
protected:
    /// Captures the packets from the machine's start until it has moved: discovery and the members' messages.
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up_and_home();
        ASSERT_TRUE(tap_.works()) << "raw sockets need root";
        ASSERT_EQ(run_lockstep({"move", "X=20", "Y=10"}).code, 0);
        ASSERT_GT(tap_.stop().size(), 1000U);
    }

    /// Sends 24,000 packets of the source, 4,000 in a second.
    template <typename Source>
    void flood(Source source) const {
        constexpr int kPackets = 24'000;
        const auto begun = steady_clock::now();
        for (int sent = 0; sent < kPackets; ++sent) {
            tap_.send(source.next());
            if (sent % 30 == 0) { std::this_thread::sleep_until(begun + sent * 250us); }
        }
    }

    /// Resets a fault that the silence may have caused. Returns whether the machine is ready.
    bool is_ready() const {
        if (run_lockstep({"reset"}).code != 0) { return false; }
        const Ran ran = run_lockstep({"status", "--json"});
        if (ran.code != 0) { return false; }
        const auto report = ran.json<proto::StatusReport>();
        return report.phase() == "Idle" && report.axes(0).present() && report.axes(1).present();
    }

    /// Waits until the machine is ready; then the axes move on command.
    void expect_recovers() const {
        const auto stopped = steady_clock::now();
        ASSERT_TRUE(eventually([&] { return is_ready() && run_lockstep({"home"}).code == 0; }));
        std::cout << "homed " << std::chrono::duration<double>(steady_clock::now() - stopped).count()
                  << " s after the packets stopped" << std::endl;
        const Ran moved = run_lockstep({"move", "X=30", "Y=20"});
        ASSERT_EQ(moved.code, 0) << moved.out << moved.err;
        EXPECT_TRUE(eventually([&] {
            const proto::StatusReport report = status();
            return report.axes(0).position_steps() == 2400 && report.axes(1).position_steps() == 1600;
        }));
    }

    PacketTap tap_;
};

TEST_F(Flooded, TheMachineIsReadyAgainWithinTenSecondsAfterThePacketsStop) {
    for (const unsigned seed : {1U, 2U}) {
        flood(PacketForger(tap_.packets(), seed));
        expect_recovers();
    }
    const proto::StatusReport report = status();
    EXPECT_GT(report.participant_reopened() + report.axes(0).health().participant_reopened() +
                  report.axes(1).health().participant_reopened(),
              0U);
    const std::string logs = text_of_log("coordinator") + text_of_log("axis-X") + text_of_log("axis-Y");
    EXPECT_NE(logs.find("opens its DDS participant again: "), logs.npos) << "so the packets had an effect";
}

/// Each on a new machine: packets of a participant that was opened again since have no effect any more.
class FloodedByDamage : public Flooded, public testing::WithParamInterface<unsigned> {};

TEST_P(FloodedByDamage, TheMachineIsReadyAgainWithinTenSecondsAfterThePacketsStop) {
    flood(PacketDamage(tap_.packets(), GetParam()));
    expect_recovers();
}

INSTANTIATE_TEST_SUITE_P(Seeds, FloodedByDamage, testing::Values(1U, 2U, 3U));

}  // namespace
}  // namespace lockstep
