// The doctor's findings about a host: problems and their remedies.
#include "clients/doctor/ratings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/documents/machine_file.hpp"

namespace lockstep::doctor {
namespace {

using testing::HasSubstr;

constexpr InterfaceFacts kFine{.exists = true, .up = true, .has_address = true, .multicast = true};
const NetworkConfig kEthernet{.interface = "eth0"};

TEST(DoctorOnTheInterface, NamesTheProblemAndTheCommandThatCorrectsIt) {
    EXPECT_EQ(rate_interface(kEthernet, kFine).rating, Rating::Good);
    EXPECT_THAT(rate_interface({.interface = "eth7"}, {}).found, HasSubstr("no interface eth7"));
    EXPECT_EQ(rate_interface(kEthernet, {.exists = true}).remedy, "ip link set eth0 up");
    EXPECT_THAT(rate_interface(kEthernet, {.exists = true, .up = true}).found, HasSubstr("no IPv4 address"));
    InterfaceFacts silent = kFine;
    silent.multicast = false;
    EXPECT_EQ(rate_interface(kEthernet, silent).remedy, "ip link set eth0 multicast on; or network.peers");
    EXPECT_EQ(rate_interface({.interface = "lo"}, silent).rating, Rating::Good) << "lo supports it anyway";
}

TEST(DoctorOnABoard, NamesAllThatItLacks) {
    const BoardLinkConfig board{.name = "pico1", .link = {LinkName::Kind::Serial, "/dev/ttyUSB0"}};
    EXPECT_EQ(rate_board(board, {}).rating, Rating::Good);
    const Finding lacks = rate_board(board, {"its motor 0: too slow", "its motor 1: missing"});
    EXPECT_EQ(lacks.rating, Rating::Bad);
    EXPECT_EQ(lacks.found, "its motor 0: too slow; its motor 1: missing");
    EXPECT_THAT(lacks.remedy, HasSubstr("lockstep board check --board pico1"));
}

TEST(DoctorOnMulticast, NeedsARouteAndReceptionOfItsOwnMessages) {
    EXPECT_EQ(rate_route({}, {}, true).rating, Rating::Good);
    EXPECT_EQ(rate_route({}, std::unexpected("no route"), {}).remedy, "ip route add 224.0.0.0/4 dev lo");
    EXPECT_EQ(rate_route({}, {}, false).rating, Rating::Bad);
}

TEST(DoctorOnMulticast, IsNotNeededWithNamedPeers) {
    const NetworkConfig peers{.interface = "eth0", .peers = {"10.0.0.1"}};
    EXPECT_EQ(rate_interface(peers, {.exists = true, .up = true, .has_address = true}).rating, Rating::Good);
    EXPECT_EQ(rate_route(peers, std::unexpected("no route"), {}).rating, Rating::Good);
    EXPECT_THAT(rate_route(peers, {}, false).found, HasSubstr("LCM does"));
}

TEST(DoctorOnTheBuffer, ASmallerOneThanTheUrlRequestsMayLoseBursts) {
    EXPECT_EQ(buffer_asked(NetworkConfig{}.lcm_url), 4'194'304);
    EXPECT_EQ(rate_buffer(4'194'304, 4'194'304).rating, Rating::Good);
    const Finding small = rate_buffer(4'194'304, 212'992);
    EXPECT_EQ(small.rating, Rating::Doubtful);
    EXPECT_EQ(small.remedy, "sysctl -w net.core.rmem_max=4194304");
}

TEST(DoctorOnTheBuffer, ASmallerOneThanAbsentPeersFillMaySilenceAPart) {
    EXPECT_EQ(rate_send_buffer(400'000, 425'984).rating, Rating::Good);
    const Finding small = rate_send_buffer(449'536, 425'984);
    EXPECT_EQ(small.rating, Rating::Doubtful);
    EXPECT_EQ(small.remedy, "sysctl -w net.core.wmem_max=449536");
}

TEST(DoctorOnStates, ManyAxesOnOneHostShareTheirMemory) {
    MachineSetup machine;
    machine.axes.resize(15);
    EXPECT_EQ(rate_states(machine, "").rating, Rating::Good);
    machine.axes.resize(16);
    const Finding many = rate_states(machine, "");
    EXPECT_EQ(many.rating, Rating::Doubtful);
    EXPECT_THAT(many.found, HasSubstr("16 axes on one host receive 240 states"));
    EXPECT_THAT(many.remedy, HasSubstr("one_host: true"));
    machine.network.interface = "eth0";
    EXPECT_EQ(rate_states(machine, "").rating, Rating::Good) << "they may be on many hosts";
    machine.network = {.one_host = true};
    EXPECT_EQ(rate_states(machine, "/dev/shm/lockstep-0/mill.0.states").rating, Rating::Good);
    EXPECT_EQ(rate_states(machine, std::unexpected(std::string("no space left"))).rating, Rating::Bad);
}

TEST(DoctorOnRealTime, ARefusalIsBadOnlyIfRequested) {
    const RealTimeFacts refused{.scheduler = "not permitted", .memory = "the limit is 64 KB"};
    EXPECT_EQ(rate_scheduler({}, refused).rating, Rating::Good);
    EXPECT_EQ(rate_scheduler({.priority = 80}, refused).rating, Rating::Bad);
    EXPECT_EQ(rate_memory({.priority = 80}, refused).rating, Rating::Bad);
    EXPECT_EQ(rate_scheduler({.priority = 80}, {}).rating, Rating::Good);
}

TEST(DoctorOnStalls, AreRatedByTheTimingsAllowance) {
    const ProtocolTiming bears_100_ms;
    EXPECT_EQ(rate_stalls(bears_100_ms, {.worst_us = 30'000, .seconds = 3}).rating, Rating::Good);
    EXPECT_EQ(rate_stalls(bears_100_ms, {.worst_us = 60'000, .seconds = 3}).rating, Rating::Doubtful);
    const Finding bad = rate_stalls(bears_100_ms, {.worst_us = 120'000, .seconds = 3});
    EXPECT_EQ(bad.rating, Rating::Bad);
    EXPECT_THAT(bad.remedy, HasSubstr("timing { slot_us: 50000 stall_slots: 5"));
}

TEST(DoctorOnStalls, ProposedTimingIsAcceptedAndAllowsTwiceTheMeasuredStall) {
    for (const double worst_us : {0.0, 80.0, 400.0, 3'000.0, 20'000.0, 50'000.0, 240'000.0}) {
        const ProtocolTiming today{.segment_entries = worst_us > 1000 ? 64 : 1024};
        MachineSetup machine{{.name = "m", .timing = timing_for({.worst_us = worst_us}, today)}};
        machine.axes = {{.name = "X",
                         .steps_per_mm = 80,
                         .start_velocity_mm_s = 10,
                         .max_velocity_mm_s = 150,
                         .max_accel_mm_s2 = 1500,
                         .max_decel_mm_s2 = 1500,
                         .position_max_mm = 200,
                         .homing = {.search_velocity_mm_s = 10, .latch_velocity_mm_s = 2, .pulloff_mm = 2},
                         .plant = {.start_position_mm = 100,
                                   .travel_margin_mm = 2,
                                   .max_torque_accel_mm_s2 = 2000,
                                   .max_jump_mm_s = 15}}};
        const auto read = parse_machine(machine_text(machine));
        ASSERT_TRUE(read) << to_text("machine", read.error());
        const ProtocolTiming& timing = read->timing;
        EXPECT_EQ(timing.segment_entries, today.segment_entries) << "the devices stay as they are";
        EXPECT_GE(static_cast<double>(timing.slot_us * timing.stall_slots), 2 * worst_us);
    }
}

TEST(DoctorOnTheClock, PtpNeedsAServiceThatKeepsIt) {
    const ClockFacts kept{.source = "tsc", .synchronised = true, .tai_offset_s = 37};
    EXPECT_EQ(rate_clock(TimeSource::Ptp, kept).rating, Rating::Good);
    EXPECT_THAT(rate_clock(TimeSource::Ptp, {.source = "tsc"}).remedy, HasSubstr("phc2sys"));
    EXPECT_EQ(rate_clock(TimeSource::Shared, {.source = "tsc"}).rating, Rating::Good);
    EXPECT_EQ(rate_clock(TimeSource::Shared, {.source = "hpet"}).rating, Rating::Doubtful);
}

TEST(DoctorOnProcesses, AnotherConfigurationIsBadAndAMissingProcessIsDoubtful) {
    EXPECT_EQ(rate_process({"axis X", true, 7}, 7).rating, Rating::Good);
    EXPECT_EQ(rate_process({"axis X", true, 8}, 7).rating, Rating::Bad);
    EXPECT_EQ(rate_process({"axis X"}, 7).rating, Rating::Doubtful);
    EXPECT_EQ(rate_process({"axis X", true, 7, {"board-b"}}, 7).host, "board-b");
    const Finding twice = rate_process({"axis X", true, 7, {"board-b", "board-c"}}, 7);
    EXPECT_EQ(twice.rating, Rating::Bad);
    EXPECT_EQ(twice.found, "runs more than once, on board-b, board-c");
    EXPECT_EQ(rate_process({"coordinator", true, 7, {"board-a", "board-b"}, true}, 7).rating, Rating::Good);
}

}  // namespace
}  // namespace lockstep::doctor
