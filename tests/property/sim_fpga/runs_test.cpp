// For any frames, a device makes the same steps as the tick-by-tick form of the same segments. The division of its time
// into calls does not matter.
#include "core/step/tick_engine.hpp"
#include "tests/property/sim_fpga/any_run.hpp"

namespace lockstep {
namespace {

template <typename Pieces>
void execute(const Pieces& pieces, Tick& tick, Position& at, std::vector<StepEdge>& steps) {
    for (const Piece& piece : pieces) {
        const Segment segment{tick, at, piece};
        tick_by_tick(segment, [&](StepEdge step) { steps.push_back(step); });
        tick = segment.end();
        at = segment.to();
    }
}

/// The bodies of the armed frames without a veto, and the tail of the last one, by the protocol's definition.
std::vector<StepEdge> expected_steps(const Run& run) {
    std::vector<StepEdge> steps;
    const FrameNumber ran = run.ran();
    Tick tick = run.frames.front().start;
    Position at = run.frames.front().track.from;
    for (FrameNumber k = 0; k < ran; ++k) { execute(run.frames[k].track.body, tick, at, steps); }
    if (ran > 0 && !run.frames[ran - 1].last) { execute(run.frames[ran - 1].track.tail, tick, at, steps); }
    return steps;
}

void load(DeviceBench& bench, const Run& run) {
    bench.order(device::BeginRun{1});
    for (const device::LoadFrame& frame : run.frames) { bench.order(frame); }
    bench.order(device::Arm{run.armed});
    bench.order(device::Veto{run.vetoed});
}

constexpr Tick kEnd{20'000};

RC_GTEST_PROP(Runs, AnyFramesStepAsTickByTick, ()) {
    const Run run = any_run();
    DeviceBench bench(endless_axis());
    load(bench, run);
    const DeviceStatus after = bench.at(kEnd);
    const std::vector<StepEdge> steps = bench.steps();
    RC_ASSERT(steps == expected_steps(run));
    std::int64_t count = 0;
    for (const StepEdge step : steps) { count += step.direction; }
    RC_ASSERT(after.position.count() == count);
    RC_ASSERT(!after.bad_segment && !after.moving);
}

RC_GTEST_PROP(Runs, TimeMayBeCutIntoAnyCalls, ()) {
    const Run run = any_run();
    DeviceBench bench(endless_axis());
    load(bench, run);
    for (Tick now; now < kEnd; now += any_time_to_next_call(1000)) { bench.device.advance(now); }
    bench.device.advance(kEnd);
    RC_ASSERT(bench.steps() == expected_steps(run));
}

/// Host and hardware words of any value end no process. The slide still moves at most one step a tick.
RC_GTEST_PROP(Runs, AnyValuesInTheWindowAreTolerated, ()) {
    DeviceBench bench;
    load(bench, any_run());
    for (int k = 0; k < 40; ++k) {
        const std::size_t entry =
            registers::kSegmentRing + *rc::gen::inRange<std::size_t>(0, 40) * registers::kSegmentRingEntryBytes;
        const std::size_t output =
            registers::kOutputRing + *rc::gen::inRange<std::size_t>(0, 8) * registers::kOutputRingEntryBytes;
        const std::size_t words[] = {registers::kRunRequest + *rc::gen::inRange<std::size_t>(0, 13) * 8,
                                     registers::kSetupRequest + *rc::gen::inRange<std::size_t>(0, 17) * 8,
                                     registers::kInputTable + *rc::gen::inRange<std::size_t>(0, 8) * 8,
                                     output + *rc::gen::inRange<std::size_t>(0, 4) * 8,
                                     entry + *rc::gen::inRange<std::size_t>(0, 4) * 8};
        bench.window.store(words[*rc::gen::inRange(0, 5)], *rc::gen::arbitrary<std::uint64_t>());
        const std::int64_t before = bench.device.plant().encoder();
        bench.device.advance(Tick{k * 100});
        RC_ASSERT(std::abs(bench.device.plant().encoder() - before) <= 100);
        (void)bench.driver.read();
        (void)bench.driver.drain_capture([](StepEdge) {});
        (void)bench.driver.drain_events([](const ChannelEvent&) {});
        (void)bench.driver.apply(last_frame(1));
    }
}

}  // namespace
}  // namespace lockstep
