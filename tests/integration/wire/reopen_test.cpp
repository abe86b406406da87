// A process's link to its peers can be opened again any number of times, and leaves nothing behind.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>

#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/reopenable.hpp"
#include "tests/integration/wire/child.hpp"
#include "tests/integration/wire/eventually.hpp"
#include "tests/integration/wire/own_network.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

struct Link {
    AxisBus bus;
};

Reopenable<Link>::Open opener(const NetworkConfig& network) {
    return [network]() -> std::expected<std::unique_ptr<Link>, std::string> {
        auto bus = open_bus<AxisBus>(network, "mill", {.axis = 1, .credentials = {}});
        if (!bus) { return std::unexpected(bus.error()); }
        return std::make_unique<Link>(std::move(*bus));
    };
}

std::ptrdiff_t entries(const char* directory) {
    return std::distance(std::filesystem::directory_iterator(directory), std::filesystem::directory_iterator());
}

/// The process's anonymous memory, in KB.
long anonymous_memory_kb() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("RssAnon:")) { return std::stol(line.substr(8)); }
    }
    return 0;
}

struct Use {
    std::ptrdiff_t descriptors = entries("/proc/self/fd");
    std::ptrdiff_t threads = entries("/proc/self/task");
    long memory_kb = anonymous_memory_kb();
};

/// The link is open again, and the peer is received.
bool comes_back(Reopenable<Link>& link) {
    link.reopen();
    return eventually([&] {
        Link* const open = link.get();
        return open != nullptr && open->bus.states.take([](AxisState&&) {}) > 0;
    });
}

TEST(Reopened, ALinkOpenedManyTimesReceivesEachTimeAndLeavesNothingBehind) {
    const NetworkConfig network = own_network();
    const auto program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("integration_wire_peer");
    const Child peer = Child::execute({program.string(), "publisher", std::to_string(network.domain)});
    const auto open = opener(network);
    auto first = open();
    ASSERT_TRUE(first) << first.error();
    Reopenable<Link> link(std::move(*first), open, [](const std::string& why) { std::cerr << why << '\n'; });
    for (int i = 0; i < 20; ++i) { ASSERT_TRUE(comes_back(link)) << i; }
    const Use before;
    for (int i = 0; i < 100; ++i) { ASSERT_TRUE(comes_back(link)) << i; }
    const Use after;
    std::cout << "opened 100 times: memory " << before.memory_kb << " to " << after.memory_kb << " KB, descriptors "
              << before.descriptors << " to " << after.descriptors << ", threads " << before.threads << " to "
              << after.threads << '\n';
    EXPECT_EQ(after.descriptors, before.descriptors);
    EXPECT_EQ(after.threads, before.threads);
    EXPECT_LT(after.memory_kb, before.memory_kb + 2000);
}

TEST(Reopened, ALinkThatCannotBeOpenedIsTriedAgainUntilItOpens) {
    const NetworkConfig network = own_network();
    const auto open = opener(network);
    std::atomic<int> failures = 0;
    auto first = open();
    ASSERT_TRUE(first) << first.error();
    Reopenable<Link> link(
        std::move(*first),
        [&]() -> std::expected<std::unique_ptr<Link>, std::string> {
            if (failures < 2) { return std::unexpected("the interface is not there"); }
            return open();
        },
        [&](const std::string&) { ++failures; });
    link.reopen();
    EXPECT_EQ(link.get(), nullptr);
    EXPECT_TRUE(eventually([&] { return link.get() != nullptr; }));
    EXPECT_EQ(failures, 2);
}

TEST(Reopened, ALinkThatCannotBeOpenedDoesNotKeepItsProcessFromEnding) {
    std::atomic<int> failures = 0;
    auto first = opener(own_network())();
    ASSERT_TRUE(first) << first.error();
    Reopenable<Link> link(
        std::move(*first), []() -> std::expected<std::unique_ptr<Link>, std::string> { return std::unexpected(""); },
        [&](const std::string&) { ++failures; });
    link.reopen();
    ASSERT_TRUE(eventually([&] { return failures > 0; }));
}

}  // namespace
}  // namespace lockstep
