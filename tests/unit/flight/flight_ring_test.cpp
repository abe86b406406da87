// Other processes can read a process's last notes at any time, even after its death.
#include "services/flight/flight_ring.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "tests/unit/flight/flight_makers.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

class Ring : public FlightFolder {};

TEST_F(Ring, IsReadAsItWasWritten) {
    FlightRing ring = FlightRing::create(rings(), source(), 100).value();
    const FlightEvent event{.tick = Tick{-5},
                            .kind = FlightKind::Vetoed,
                            .about = flight_axis(MotorIndex{31}),
                            .detail = 2,
                            .fault = FaultCode::LimitHit,
                            .epoch = 0xFFFF'FFFF'FFFF'FFFFU,
                            .frame = 17,
                            .count = -3,
                            .amount = -0.25,
                            .lasts = {9}};
    ring.add(event);
    const auto read = read_ring(ring.path());
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read->source, source());
    ASSERT_EQ(read->events.size(), 1U);
    EXPECT_EQ(read->events[0], (NumberedEvent{1, event}));
}

TEST_F(Ring, KeepsTheNewestInTheirOrder) {
    FlightRing ring = FlightRing::create(rings(), source(), 10).value();
    for (std::int64_t i = 1; i <= 25; ++i) { ring.add(noted(i)); }
    const auto snapshot = read_ring(ring.path());
    ASSERT_TRUE(snapshot) << snapshot.error();
    const auto& events = snapshot->events;
    ASSERT_EQ(events.size(), 10U);
    for (std::size_t i = 0; i < events.size(); ++i) {
        EXPECT_EQ(events[i].number, 16 + i);
        EXPECT_EQ(events[i].event.tick, Tick{static_cast<std::int64_t>(16 + i)});
    }
}

TEST_F(Ring, IsReadWholeEventByEventWhileItIsWritten) {
    FlightRing ring = FlightRing::create(rings(), source(), 64).value();
    std::jthread writer([&](const std::stop_token& stop) {
        for (std::int64_t i = 1; !stop.stop_requested(); ++i) {
            ring.add({.tick = Tick{i}, .epoch = static_cast<Epoch>(i), .count = i, .lasts = {i}});
        }
    });
    for (int i = 0; i < 2000; ++i) {
        const auto snapshot = read_ring(ring.path());
        ASSERT_TRUE(snapshot) << snapshot.error();
        for (const NumberedEvent& read : snapshot->events) {
            const auto number = static_cast<std::int64_t>(read.number);
            ASSERT_EQ(read.event.tick, Tick{number});
            ASSERT_EQ(read.event.epoch, read.number);
            ASSERT_EQ(read.event.count, number);
            ASSERT_EQ(read.event.lasts, Ticks{number});
        }
    }
}

TEST_F(Ring, IsRemovedByAProcessThatEndsOnRequest) {
    { const auto ring = FlightRing::create(rings(), source(), 10); }
    EXPECT_TRUE(rings_in(rings()).empty());
}

TEST_F(Ring, OutlivesAProcessThatIsKilled) {
    const pid_t child = fork();
    if (child == 0) {
        FlightRing ring = FlightRing::create(rings(), source(), 10).value();
        ring.add(noted(42));
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    ASSERT_EQ(rings_in(rings()).size(), 1U);
    auto left = LeftRing::claim(rings_in(rings())[0]);
    ASSERT_TRUE(left);
    EXPECT_FALSE(LeftRing::claim(rings_in(rings())[0])) << "it is claimed already";
    EXPECT_EQ(read_ring(rings_in(rings())[0])->events.at(0).event, noted(42));
    left->remove();
    EXPECT_TRUE(rings_in(rings()).empty());
}

TEST_F(Ring, OfALivingProcessCannotBeClaimed) {
    const auto ring = FlightRing::create(rings(), source(), 10);
    EXPECT_FALSE(LeftRing::claim(ring->path()));
}

TEST_F(Ring, IsForThisUserAlone) {
    const auto ring = FlightRing::create(rings(), source(), 10);
    EXPECT_EQ(fs::status(rings()).permissions(), fs::perms::owner_all);
    fs::remove_all(folder / "other");
    fs::create_symlink(folder, folder / "other");
    EXPECT_FALSE(FlightRing::create(folder / "other", source(), 10)) << "another user may have put it there";
}

TEST_F(Ring, DamagedIsRefusedOrHarmless) {
    const auto ring = FlightRing::create(rings(), source(), 4);
    std::ifstream file(ring->path(), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    const fs::path damaged = folder / "damaged.ring";
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        std::ofstream(damaged, std::ios::binary) << whole.substr(0, length);
        (void)read_ring(damaged);
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(0xFF);
        std::ofstream(damaged, std::ios::binary) << bytes;
        (void)read_ring(damaged);
    }
    EXPECT_FALSE(read_ring(folder / "none.ring"));
}

}  // namespace
}  // namespace lockstep
