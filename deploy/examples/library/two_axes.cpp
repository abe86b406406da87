// Plans a path of two axes as frames, and runs the frames as steps. Every axis ends exactly on the commanded step.
#include <array>
#include <cstdio>

#include "core/path/path_planner.hpp"
#include "core/step/engine.hpp"

namespace {

using namespace lockstep;

MachineConfig plotter() {
    AxisConfig axis{.name = "X",
                    .steps_per_mm = 80,
                    .start_velocity_mm_s = 10,
                    .max_velocity_mm_s = 150,
                    .max_accel_mm_s2 = 1500,
                    .max_decel_mm_s2 = 1500,
                    .position_max_mm = 200};
    MachineConfig machine{.name = "plotter"};
    machine.axes = {axis, axis};
    machine.axes[1].name = "Y";
    return machine;
}

/// Runs the body of one axis's track in a frame. Returns the end position.
Position run(const AxisTrack& track, int& steps) {
    StepEngine engine(Tick{}, track.from);
    for (const Piece& piece : track.body) {
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks, [&](StepEdge) { ++steps; });
    }
    return engine.position();
}

}  // namespace

int main() {
    const MachineConfig machine = plotter();
    PathPlanner planner(path_setup_of(machine));
    const std::array rest{rest_position(0, false), rest_position(0, false)};
    const double feed_mm_per_tick = 100.0 / machine.ticks_per_second();
    planner.begin(rest);
    planner.line({{60, 20}}, {.feed_mm_per_tick = feed_mm_per_tick}, 1);
    planner.line({{60, 80}}, {.feed_mm_per_tick = feed_mm_per_tick}, 2);
    planner.finish();

    std::array<int, 2> steps{};
    std::array<Position, 2> at{};
    for (int number = 1; !planner.is_done(); ++number) {
        const auto frame = planner.next();
        if (!frame || !*frame) { return 1; }  // the limits contradict each other, or moves are missing
        for (std::size_t axis = 0; axis < 2; ++axis) { at[axis] = run((*frame)->axes[axis], steps[axis]); }
        std::printf("frame %2d: %6.1f ms, X %8.3f mm, Y %8.3f mm\n", number,
                    machine.microseconds((*frame)->ticks) / 1000, at[0].as_steps() / 80, at[1].as_steps() / 80);
    }
    std::printf("%d and %d steps\n", steps[0], steps[1]);
    return at[0].count() == 60 * 80 && at[1].count() == 80 * 80 ? 0 : 1;
}
