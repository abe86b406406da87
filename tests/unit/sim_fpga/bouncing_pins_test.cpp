// Contacts that bounce: what their pins show, and what a device's input makes of them.
#include <gmock/gmock.h>

#include "sim_fpga/wiring/bouncing_pins.hpp"
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

using testing::SizeIs;

constexpr std::uint32_t kPin = 1U << 4;

/// The ticks at which the pin changes, by one look at each tick.
std::vector<Tick> changes_of(BouncingPins& pins, std::uint32_t level, Tick from, Tick until, std::uint32_t before) {
    std::vector<Tick> changes;
    for (Tick at = from; at <= until; at += Ticks{1}) {
        const std::uint32_t shown = pins.look(level, at);
        if (shown != before) { changes.push_back(at); }
        before = shown;
    }
    return changes;
}

TEST(BouncingPins, ShowBothLevelsInTurnUntilTheirTimeIsOver) {
    BouncingPins pins;
    pins.bounce(4, Ticks{1000});
    EXPECT_EQ(pins.look(0, Tick{0}), 0U) << "nothing bounces at power-up";
    EXPECT_EQ(pins.next(), std::nullopt);
    const std::vector<Tick> changes = changes_of(pins, kPin, Tick{100}, Tick{5000}, 0);
    EXPECT_GE(changes.size(), 5U);
    EXPECT_EQ(changes.size() % 2, 1U) << "it closes in the end";
    EXPECT_EQ(changes.front(), Tick{100});
    EXPECT_LE(changes.back(), Tick{1100});
    EXPECT_EQ(pins.next(), std::nullopt);
    EXPECT_EQ(changes_of(pins, 0, Tick{6000}, Tick{9000}, kPin).size() % 2, 1U) << "it also bounces as it opens";
}

TEST(BouncingPins, NameEachTickAtWhichTheyChange) {
    BouncingPins looked_at, asked;
    for (BouncingPins* const pins : {&looked_at, &asked}) {
        pins->bounce(4, Ticks{500});
        (void)pins->look(0, Tick{0});
    }
    const std::vector<Tick> changes = changes_of(looked_at, kPin, Tick{10}, Tick{2000}, 0);
    std::vector<Tick> named{Tick{10}};
    std::uint32_t before = asked.look(kPin, Tick{10});
    while (const auto next = asked.next()) {
        const std::uint32_t shown = asked.look(kPin, *next);
        if (shown != before) { named.push_back(*next); }
        before = shown;
    }
    EXPECT_EQ(named, changes);
}

/// The events of input 4 after its contact has closed, with this debounce. The contact bounces for 100 ticks.
std::vector<ChannelEvent> events_with(Ticks debounce) {
    DeviceSetup setup;
    setup.debounce[4] = debounce;
    DeviceBench bench(endless_axis(), {}, RegisterWindow::in_process(), setup);
    bench.device.plant().wiring().bounce(4, Ticks{100});
    (void)bench.at(Tick{1000});
    bench.device.plant().set_pin(4, true);
    (void)bench.at(Tick{5000});
    std::vector<ChannelEvent> seen;
    EXPECT_TRUE(bench.driver.drain_events([&](const ChannelEvent& event) { seen.push_back(event); }));
    return seen;
}

TEST(BouncingInputs, ChangeOnceIfTheirDebounceIsLongerThanTheBounce) {
    const std::vector<ChannelEvent> seen = events_with(Ticks{200});
    ASSERT_THAT(seen, SizeIs(1));
    EXPECT_TRUE(seen[0].closed);
    EXPECT_GE(seen[0].tick, Tick{1200});
    EXPECT_LE(seen[0].tick, Tick{1300}) << "after its last bounce the pin kept its level for the debounce";
}

TEST(BouncingInputs, ChangeSeveralTimesIfTheBounceIsLonger) {
    const std::vector<ChannelEvent> seen = events_with(Ticks{0});
    ASSERT_GE(seen.size(), 3U);
    for (std::size_t i = 0; i < seen.size(); ++i) { EXPECT_EQ(seen[i].closed, i % 2 == 0) << i; }
    EXPECT_EQ(seen.front().tick, Tick{1000});
    EXPECT_TRUE(seen.back().closed);
}

}  // namespace
}  // namespace lockstep
