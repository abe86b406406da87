// Real DDS on the loopback: the guarantees between processes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>

#include "services/wire/bus/bus.hpp"
#include "tests/integration/wire/child.hpp"
#include "tests/integration/wire/eventually.hpp"
#include "tests/integration/wire/own_network.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

template <typename Bus>
Bus open_or_throw(const NetworkConfig& network, const std::string& machine = "mill",
                  std::optional<std::uint32_t> axis = {}) {
    auto bus = open_bus<Bus>(network, machine, {.axis = axis, .credentials = {}});
    if (!bus) { throw std::runtime_error(bus.error()); }
    return std::move(*bus);
}

Frame frame_of(FrameNumber number, std::size_t axes, std::size_t pieces) {
    Frame frame{.term = {1, 1},
                .epoch = 2,
                .number = number,
                .start = {1000},
                .ticks = {5000},
                .axes = std::vector<AxisTrack>(axes)};
    for (AxisTrack& axis : frame.axes) {
        while (axis.body.size() < pieces) {
            (void)axis.body.push_back({{10}, {static_cast<std::int64_t>(number)}, {-1}});
        }
    }
    return frame;
}

constexpr auto kIgnore = [](AxisState&&) {};

/// Waits until the axis's states are received there.
template <typename States>
bool is_received(AxisBus& axis, std::uint32_t number, States& there) {
    return eventually([&] {
        axis.state.write({.axis = number});
        return there.take(kIgnore) > 0;
    });
}

/// A separate process: see peer.cpp.
Child peer(const std::string& role, const NetworkConfig& network) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("integration_wire_peer");
    return Child::execute({program.string(), role, std::to_string(network.domain), std::to_string(network.processes)});
}

TEST(Dds, FramesArriveWholeAndInOrder) {
    const NetworkConfig network = own_network();
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    auto axis = open_or_throw<AxisBus>(network);
    ASSERT_TRUE(eventually([&] { return coordinator.frames.matched() == 1 && axis.frames.matched() == 1; }));
    for (FrameNumber number = 1; number <= 50; ++number) {
        ASSERT_TRUE(coordinator.frames.write(frame_of(number, 3, 10)));
    }
    std::vector<Frame> received;
    ASSERT_TRUE(eventually([&] {
        axis.frames.take([&](Frame&& frame) { received.push_back(std::move(frame)); });
        return received.size() == 50;
    }));
    for (FrameNumber number = 1; number <= 50; ++number) { EXPECT_EQ(received[number - 1], frame_of(number, 3, 10)); }
    EXPECT_EQ(axis.frames.refusals().count, 0u);
}

TEST(Dds, TheLargestFrameArrives) {
    const NetworkConfig network = own_network();
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    auto axis = open_or_throw<AxisBus>(network);
    ASSERT_TRUE(eventually([&] { return coordinator.frames.matched() == 1 && axis.frames.matched() == 1; }));
    const Frame largest = frame_of(1, kMaxAxes, kMaxBodyPieces);
    ASSERT_TRUE(coordinator.frames.write(largest));
    std::vector<Frame> received;
    ASSERT_TRUE(
        eventually([&] { return axis.frames.take([&](Frame&& frame) { received.push_back(std::move(frame)); }) > 0; }));
    EXPECT_EQ(received[0], largest);
}

TEST(Dds, MachinesInOneDomainDoNotReceiveEachOther) {
    const NetworkConfig network = own_network();
    auto coordinator = open_or_throw<CoordinatorBus>(network, "mill");
    auto axis = open_or_throw<AxisBus>(network, "mill");
    auto foreign = open_or_throw<AxisBus>(network, "lathe");
    ASSERT_TRUE(eventually([&] { return axis.machine.matched() == 1; }));
    ASSERT_TRUE(eventually([&] {
        coordinator.machine.write({});
        return axis.machine.take([](MachineState&&) {}) > 0;
    }));
    EXPECT_EQ(foreign.machine.matched(), 0u);
    EXPECT_EQ(foreign.machine.take([](MachineState&&) {}), 0u);
}

TEST(Dds, AnAxisDoesNotReceiveItself) {
    const NetworkConfig network = own_network();
    auto first = open_or_throw<AxisBus>(network, "mill", 0);
    auto second = open_or_throw<AxisBus>(network, "mill", 1);
    ASSERT_TRUE(eventually([&] { return first.states.matched() == 1 && second.states.matched() == 1; }));
    std::map<std::uint32_t, int> received_by_first;
    ASSERT_TRUE(eventually([&] {
        first.state.write({.axis = 0});
        second.state.write({.axis = 1});
        first.states.take([&](AxisState&& state) { ++received_by_first[state.axis]; });
        return received_by_first[1] > 3;
    }));
    EXPECT_EQ(received_by_first[0], 0);
}

TEST(Dds, AMachineOnOneHostShowsItsStatesSeldomAndItsNewsAtOnce) {
    NetworkConfig network = own_network();
    network.one_host = true;
    auto viewer = open_or_throw<ViewerBus>(network);
    auto axis = open_or_throw<AxisBus>(network, "mill", 1);
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(is_received(axis, 1, viewer.states));
    (void)coordinator.states.take(kIgnore);
    constexpr Slot kWritten = 200;
    const auto begun = std::chrono::steady_clock::now();
    for (Slot stamp = 1; stamp <= kWritten; ++stamp) { axis.state.write({.axis = 1, .stamp = stamp}); }
    axis.state.write({.axis = 1, .stamp = kWritten + 1, .homed = true});
    const auto lasted = std::chrono::steady_clock::now() - begun;
    EXPECT_EQ(coordinator.states.take(kIgnore), kWritten + 1) << "all of them through memory";
    std::vector<AxisState> shown;
    ASSERT_TRUE(eventually([&] {
        viewer.states.take([&](AxisState&& state) { shown.push_back(state); });
        return !shown.empty() && shown.back().homed;
    }));
    EXPECT_LE(shown.size(), 2U + static_cast<std::size_t>(lasted / 100ms));
}

TEST(Dds, AcceptsMessagesAboutAnAxisOnlyFromIt) {
    const NetworkConfig network = own_network();
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    auto axis = open_or_throw<AxisBus>(network, "mill", 1);
    std::size_t believed = 0;
    ASSERT_TRUE(eventually([&] {
        axis.state.write({.axis = 0});
        believed += coordinator.states.take([](AxisState&&) {});
        return coordinator.states.refusals().count > 3;
    }));
    EXPECT_EQ(believed, 0U);
    EXPECT_EQ(coordinator.states.refusals().last,
              "lockstep/axis_state: is about axis 0, but its writer is not that axis");
    ASSERT_TRUE(eventually([&] {
        axis.state.write({.axis = 1});
        return coordinator.states.take([](AxisState&&) {}) > 0;
    }));
}

TEST(Dds, ALateJoinerGetsNoOldCommand) {
    const NetworkConfig network = own_network();
    auto client = open_or_throw<ClientBus>(network);
    auto early = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(eventually([&] { return client.commands.matched() == 1; }));
    ASSERT_TRUE(client.commands.write({.sequence = 1}));
    ASSERT_TRUE(eventually([&] { return early.commands.take([](Command&&) {}) == 1; }));

    auto late = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(eventually([&] { return client.commands.matched() == 2 && late.commands.matched() == 1; }));
    ASSERT_TRUE(client.commands.write({.sequence = 2}));
    std::vector<std::uint64_t> received;
    ASSERT_TRUE(eventually(
        [&] { return late.commands.take([&](Command&& command) { received.push_back(command.sequence); }) > 0; }));
    EXPECT_EQ(received, std::vector<std::uint64_t>{2});
}

TEST(Dds, AClientSleepsUntilItsReplyComes) {
    const NetworkConfig network = own_network();
    auto client = open_or_throw<ClientBus>(network);
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(eventually([&] { return coordinator.replies.matched() == 1 && client.replies.matched() == 1; }));
    ASSERT_TRUE(coordinator.replies.write({.client = 5, .text = "done"}));
    ASSERT_TRUE(client.arrivals->wait_for(20s));
    std::string text;
    client.replies.take([&](Reply&& reply) { text = reply.text; });
    EXPECT_EQ(text, "done");
}

TEST(Dds, ACoordinatorAndAnAxisOfAnotherProcessExchangeMessages) {
    const NetworkConfig network = own_network();
    Child axis = peer("axis", network);
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(eventually([&] { return coordinator.frames.matched() == 1 && coordinator.states.matched() == 1; }));
    FrameNumber held = 0;
    for (FrameNumber number = 1; number <= 200; ++number) {
        ASSERT_TRUE(eventually([&] {  // like the coordinator: frames that are not held are sent again
            coordinator.frames.write(frame_of(number, 3, 10));
            coordinator.states.take([&](AxisState&& state) { held = std::max(held, state.held); });
            return held + 20 >= number;
        }));
    }
    ASSERT_TRUE(eventually([&] {
        coordinator.states.take([&](AxisState&& state) { held = std::max(held, state.held); });
        return held == 200;
    }));
    Frame last = frame_of(201, 3, 0);
    last.last = true;
    ASSERT_TRUE(coordinator.frames.write(last));
    EXPECT_EQ(axis.wait(), 0);
}

/// The processes that DDS knows in its domain, itself included.
int known_to(const Participant& participant) {
    const Entity reader(dds_create_reader(participant.handle(), DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr));
    std::array<void*, 16> samples{};
    std::array<dds_sample_info_t, 16> infos{};
    const int count = dds_read(reader.handle(), samples.data(), infos.data(), samples.size(), samples.size());
    if (count > 0) { dds_return_loan(reader.handle(), samples.data(), count); }
    return static_cast<int>(std::count_if(infos.begin(), infos.begin() + std::max(0, count),
                                          [](const auto& info) { return info.instance_state == DDS_IST_ALIVE; }));
}

TEST(Dds, AnEndedProcessIsGoneLongBeforeItsLeaseEnds) {
    NetworkConfig network = own_network();
    network.processes = 65;  // a lease of ten seconds
    Child axis = peer("axis", network);
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(eventually([&] { return coordinator.frames.matched() == 1 && coordinator.states.matched() == 1; }));
    ASSERT_EQ(known_to(coordinator.participant), 2);
    Frame last = frame_of(1, 3, 0);
    last.last = true;
    ASSERT_TRUE(coordinator.frames.write(last));
    ASSERT_EQ(axis.wait(), 0);
    const auto ended = std::chrono::steady_clock::now();
    ASSERT_TRUE(eventually([&] { return known_to(coordinator.participant) == 1; }));
    EXPECT_LT(std::chrono::steady_clock::now() - ended, std::chrono::seconds{5}) << "it announced that it leaves";
}

TEST(Dds, AStalledReaderDoesNotStopTheWriter) {
    const NetworkConfig network = own_network();
    Child axis = peer("axis", network);
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(eventually([&] { return coordinator.frames.matched() == 1; }));
    axis.signal(SIGSTOP);
    for (FrameNumber number = 1; number <= 200; ++number) {
        ASSERT_TRUE(coordinator.frames.write(frame_of(number, kMaxAxes, kMaxBodyPieces))) << number;
    }
    axis.signal(SIGCONT);
    Frame last = frame_of(201, 3, 0);
    last.last = true;
    ASSERT_TRUE(coordinator.frames.write(last));
    EXPECT_EQ(axis.wait(), 0);
}

TEST(Dds, AReaderWithTheLongestAllowedStallGetsEveryState) {
    const NetworkConfig network = own_network();
    auto axis = open_or_throw<AxisBus>(network, "mill", 0);
    auto coordinator = open_or_throw<CoordinatorBus>(network);
    ASSERT_TRUE(is_received(axis, 0, coordinator.states));
    std::this_thread::sleep_for(100ms);
    (void)coordinator.states.take(kIgnore);
    for (Slot stamp = 1; stamp <= kMaxStallSlots; ++stamp) { axis.state.write({.axis = 0, .stamp = stamp}); }
    std::vector<Slot> received;
    ASSERT_TRUE(eventually([&] {
        std::this_thread::sleep_for(500ms);  // takes no message before all have arrived
        coordinator.states.take([&](AxisState&& state) { received.push_back(state.stamp); });
        return received.size() >= kMaxStallSlots;
    })) << received.size();
    std::vector<Slot> all(kMaxStallSlots);
    std::iota(all.begin(), all.end(), Slot{1});
    EXPECT_EQ(received, all);
}

TEST(Dds, EveryPartOfAProgramArrivesThoughPacketsAreLost) {
    const NetworkConfig network = own_network();
    setenv(
        "CYCLONEDDS_URI",  // five packets of a hundred are lost, both ways
        "<CycloneDDS><Domain><Internal><Test><XmitLossiness>50</XmitLossiness></Test></Internal></Domain></CycloneDDS>",
        1);
    Child coordinator = peer("coordinator", network);
    auto client = open_or_throw<ClientBus>(network);
    unsetenv("CYCLONEDDS_URI");
    ASSERT_TRUE(eventually([&] { return client.chunks.matched() == 1 && client.replies.matched() == 1; }));
    constexpr std::uint32_t kChunks = 100;
    std::uint64_t answered = 0;
    for (std::uint32_t index = 0; index < kChunks; ++index) {
        ASSERT_TRUE(client.chunks.write({.client = 1,
                                         .sequence = index,
                                         .index = index,
                                         .count = kChunks,
                                         .bytes = std::vector<std::uint8_t>(8192)}));
        ASSERT_TRUE(eventually([&] {
            answered += client.replies.take([](Reply&&) {});
            return answered + 32 > index;
        })) << answered
            << " of " << index;
    }
    EXPECT_EQ(coordinator.wait(), 0);
}

TEST(Dds, AMissingInterfaceIsNamedWithTheRemedy) {
    NetworkConfig network = own_network();
    network.interface = "none0";
    const auto bus = open_bus<AxisBus>(network, "mill");
    ASSERT_FALSE(bus);
    for (const char* part : {"none0", "domain ", "ip addr show none0"}) {
        EXPECT_NE(bus.error().find(part), std::string::npos) << bus.error();
    }
    network.interface = "lo\"/><x";
    EXPECT_FALSE(open_bus<AxisBus>(network, "mill"));
    EXPECT_FALSE(open_bus<AxisBus>(own_network(), "*"));
}

}  // namespace
}  // namespace lockstep
