// For any frames, a device makes the same steps as the tick-by-tick form of the same segments. The division of its time
// into calls does not matter.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/step/tick_engine.hpp"
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

struct Run {
    std::vector<device::LoadFrame> frames;
    FrameNumber armed = 0;
    FrameNumber vetoed = 0;
};

/// Any speed up to a step per 8 ticks, with an acceleration that keeps it below twice this speed.
rc::Gen<Piece> any_piece() {
    return rc::gen::map(
        rc::gen::tuple(rc::gen::inRange(1, 400), rc::gen::inRange(-1000, 1001), rc::gen::inRange(-9, 10)),
        [](const auto& parts) {
            const auto [ticks, speed, rate] = parts;
            const std::int64_t unit = std::int64_t{1} << 51;
            return Piece{Ticks{ticks}, {speed * unit}, {rate * (unit / 8)}};
        });
}

/// Consecutive frames. Half of the time the last one has the flag `last`. Some are armed, and some may be vetoed.
Run any_run() {
    Run run;
    const auto count = *rc::gen::inRange<FrameNumber>(1, 7);
    Tick tick{*rc::gen::inRange<std::int64_t>(1, 500)};
    Position from = rest_position(0, *rc::gen::arbitrary<bool>());
    for (FrameNumber number = 1; number <= count; ++number) {
        device::LoadFrame frame{number, tick, false, {from, {}, {}}};
        for (int pieces = *rc::gen::inRange(1, 5); pieces > 0; --pieces) {
            const Piece piece = *any_piece();
            (void)frame.track.body.push_back(piece);
            tick += piece.ticks;
            from = from + piece.covered();
        }
        for (int pieces = *rc::gen::inRange(0, 4); pieces > 0; --pieces) {
            (void)frame.track.tail.push_back(*any_piece());
        }
        run.frames.push_back(frame);
    }
    run.frames.back().last = *rc::gen::arbitrary<bool>();
    run.armed = *rc::gen::inRange<FrameNumber>(0, count + 2);
    run.vetoed = *rc::gen::inRange<FrameNumber>(1, count + 2);
    return run;
}

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
    const FrameNumber ran = std::min({run.armed, run.vetoed - 1, static_cast<FrameNumber>(run.frames.size())});
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
    for (Tick now; now < kEnd; now += Ticks{*rc::gen::inRange<std::int64_t>(1, 1000)}) { bench.device.advance(now); }
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
        const std::size_t words[] = {registers::kRunRequest + *rc::gen::inRange<std::size_t>(0, 7) * 8,
                                     entry + *rc::gen::inRange<std::size_t>(0, 4) * 8};
        bench.window.store(words[*rc::gen::inRange(0, 2)], *rc::gen::arbitrary<std::uint64_t>());
        const std::int64_t before = bench.device.plant().encoder();
        bench.device.advance(Tick{k * 100});
        RC_ASSERT(std::abs(bench.device.plant().encoder() - before) <= 100);
        (void)bench.driver.read();
        (void)bench.driver.drain_capture([](StepEdge) {});
        (void)bench.driver.apply(last_frame(1));
    }
}

}  // namespace
}  // namespace lockstep
