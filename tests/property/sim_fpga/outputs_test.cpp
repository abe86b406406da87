// For any frames, outputs change at the ticks that the protocol defines: with the bodies that are run, and then with
// the tail of the last one.
#include <variant>

#include "tests/property/sim_fpga/any_run.hpp"

namespace lockstep {
namespace {

Ticks length_of(const auto& pieces) {
    Ticks ticks;
    for (const Piece& piece : pieces) { ticks += piece.ticks; }
    return ticks;
}

/// Levels of the outputs at some ticks, some of which are after the end.
template <typename Changes>
void draw_changes(Changes& changes, Ticks length) {
    std::int64_t at = 0;
    for (int left = *rc::gen::inRange(0, 5); left > 0; --left) {
        at += *rc::gen::inRange<std::int64_t>(at == 0 ? 1 : 0, length.value + 2);
        changes.append({Ticks{at}, SetDigital{static_cast<std::uint16_t>(*rc::gen::inRange(0, 256)),
                                              static_cast<std::uint16_t>(*rc::gen::inRange(0, 256))}});
    }
}

struct Level {
    Tick tick;
    std::uint16_t levels = 0;
    bool operator==(const Level&) const = default;
};

class Expected {
public:
    template <typename Changes>
    void play(const Changes& changes, Tick start, Ticks length) {
        for (const OutputChange& change : changes) {
            if (change.at > length) { return; }
            const auto& [levels, mask] = std::get<SetDigital>(change.what);
            const auto after = static_cast<std::uint16_t>((now_ & ~mask) | (levels & mask));
            if (after != now_) { seen.push_back({start + change.at, after}); }
            now_ = after;
        }
    }
    std::vector<Level> seen;

private:
    std::uint16_t now_ = 0;
};

RC_GTEST_PROP(Outputs, OfAnyFramesChangeAsTheProtocolDefines, ()) {
    Run run = any_run();
    for (device::LoadFrame& frame : run.frames) { frame.last = frame.last && frame.track.tail.empty(); }
    DeviceBench bench(endless_axis());
    bench.order(device::BeginRun{1});
    Expected expected;
    for (const device::LoadFrame& frame : run.frames) {
        const Ticks body = length_of(frame.track.body);
        device::LoadOutputs outputs{frame.number, {}};
        draw_changes(outputs.track.body, body);
        draw_changes(outputs.track.tail, length_of(frame.track.tail));
        bench.order(outputs);
        bench.order(frame);
        if (frame.number <= run.ran()) { expected.play(outputs.track.body, frame.start, body); }
        if (frame.number == run.ran() && !frame.last) {
            expected.play(outputs.track.tail, frame.start + body, length_of(frame.track.tail));
        }
    }
    bench.order(device::Arm{run.armed});
    bench.order(device::Veto{run.vetoed});
    for (Tick now; now < Tick{20'000}; now += any_time_to_next_call(3000)) { (void)bench.at(now); }
    (void)bench.at(Tick{20'000});
    std::vector<Level> seen;
    const auto drained = bench.driver.drain_events([&](const ChannelEvent& event) {
        seen.push_back({event.tick, event.levels});
    });
    RC_ASSERT(drained.has_value());
    RC_ASSERT(seen == expected.seen);
}

/// A value at any tick is what an accumulator shows that adds the slope at every tick.
RC_GTEST_PROP(Outputs, AnAnalogValueIsThatOfAnAccumulator, ()) {
    DeviceBench bench(endless_axis());
    bench.order(device::BeginRun{1});
    device::LoadOutputs outputs{1, {}};
    std::int64_t at = 0;
    for (int left = *rc::gen::inRange(1, 6); left > 0; --left) {
        at += *rc::gen::inRange<std::int64_t>(1, 300);
        outputs.track.body.append(
            {Ticks{at}, RampAnalog{.channel = 1,
                                   .value = *rc::gen::inRange<std::int64_t>(0, kFullScale),
                                   .slope = *rc::gen::inRange(-kFullScale / 300, kFullScale / 300)}});
    }
    bench.order(outputs);
    bench.order(last_frame(1));
    bench.order(device::Arm{1});
    std::int64_t value = 0;
    std::int64_t slope = 0;
    std::size_t next = 0;
    for (std::int64_t tick = 1; tick <= kBody.value; ++tick) {
        value = std::clamp<std::int64_t>(value + slope, 0, kFullScale);
        for (; next < outputs.track.body.size() && outputs.track.body[next].at == Ticks{tick}; ++next) {
            const auto& ramp = std::get<RampAnalog>(outputs.track.body[next].what);
            value = ramp.value;
            slope = ramp.slope;
        }
        (void)bench.at(kStart + Ticks{tick});
        RC_ASSERT(bench.device.outputs().analog(1, bench.device.now()) == value);
    }
}

}  // namespace
}  // namespace lockstep
