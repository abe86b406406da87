// The record contains every change of the devices' inputs, at the tick and the count at which it happened.
#include <gtest/gtest.h>

#include <map>

#include "clients/simulation/machine_recorder.hpp"
#include "services/record/record_sink.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

class ChannelsOfX : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t, std::span<const std::uint8_t> bytes) override {
        if (channel == "LOCKSTEP_RIG_X_CHANNELS") { messages.push_back(decode_lcm<channel_event_t>(bytes).value()); }
    }
    std::vector<channel_event_t> messages;
};

class ChannelRecords : public Rig, public VirtualObserver {
protected:
    explicit ChannelRecords(VirtualOptions options = {.machine = small_machine()}) : Rig(std::move(options)) {
        vm.observe(*this);
    }
    void on_step(MotorIndex axis, StepEdge step) override {
        if (axis != 0) { return; }
        count_ += step.direction;
        steps_.emplace(step.tick, count_);
    }
    /// Of X's device at a tick.
    std::int64_t count_at(Tick tick) const {
        const auto after = steps_.upper_bound(tick);
        return after == steps_.begin() ? 0 : std::prev(after)->second;
    }
    /// The home switch closes and opens at each touch, where the axis is then.
    void expect_touches_of_homing() {
        home();
        ASSERT_GE(record.messages.size(), 3U) << "homing touches the switch at least twice";
        for (std::size_t i = 0; i < record.messages.size(); ++i) {
            const auto event = event_of(record.messages[i]);
            ASSERT_TRUE(event);
            EXPECT_EQ(record.messages[i].sequence, static_cast<std::int64_t>(i));
            EXPECT_EQ(event->kind, ChannelEvent::Kind::Input);
            EXPECT_EQ(event->channel, 2) << "the home switch";
            EXPECT_EQ(event->closed, i % 2 == 0);
            EXPECT_EQ(event->value, count_at(event->tick));
        }
    }

    ChannelsOfX record;
    MachineRecorder recorder{vm, record};

private:
    std::int64_t count_ = 0;
    std::map<Tick, std::int64_t> steps_;
};

TEST_F(ChannelRecords, HaveEachTouchOfTheHomeSwitchWithItsTickAndCount) { expect_touches_of_homing(); }

class ChannelRecordsOverALink : public ChannelRecords {
protected:
    static VirtualOptions over_links() {
        VirtualOptions options{.machine = small_machine()};
        ProtocolTiming& timing = options.machine.timing;
        timing.time_source = TimeSource::Network;
        timing.clock_error_limit_us = timing.most_clock_error_us();
        options.links.assign(motor_count(options.machine), {Ticks{200}, Ticks{3000}});
        return options;
    }
    ChannelRecordsOverALink() : ChannelRecords(over_links()) {}
};

TEST_F(ChannelRecordsOverALink, HaveTheSame) { expect_touches_of_homing(); }

}  // namespace
}  // namespace lockstep
