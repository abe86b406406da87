// Random machines and programs for the path planner.
#pragma once

#include "tests/property/path/path_run.hpp"

namespace lockstep {

inline double thousandth(double mm) { return std::round(mm * 1000) / 1000; }

inline std::vector<TestAxis> random_axes(Random& random, std::size_t count) {
    std::vector<TestAxis> axes;
    for (std::size_t i = 0; i < count; ++i) {
        TestAxis axis{log_uniform(random, 20, 800), log_uniform(random, 0.5, 15), log_uniform(random, 20, 200),
                      log_uniform(random, 200, 8000), 0};
        axis.deceleration = random() % 2 == 0 ? axis.acceleration : log_uniform(random, 200, 8000);
        axes.push_back(axis);
    }
    return axes;
}

/// Moves in all directions, of all lengths; or a winding line of short chords.
inline TestProgram random_program(Random& random, std::size_t axes, bool winds) {
    TestProgram program;
    Place at(axes, 0);
    double heading = 0;
    double feed = log_uniform(random, 5, 200);
    for (int k = 0; k < (winds ? 1500 : 150); ++k) {
        if (random() % 50 == 0) { feed = log_uniform(random, 5, 200); }
        const double length = winds ? 0.03 : log_uniform(random, 0.02, 20);
        heading += uniform(random, -0.1, 0.1);
        for (std::size_t i = 0; i < axes; ++i) {
            const double part = winds ? std::cos(heading + static_cast<double>(i)) : uniform(random, -1, 1);
            at[i] = thousandth(at[i] + part * length);
        }
        program.add(at, feed);
        MoveSettings& settings = program.moves.back().settings;
        if (random() % 40 == 0) { settings.mode = PathMode::ExactStop; }
        if (random() % 20 == 0) { settings.mode = PathMode::ExactPath; }
        if (random() % 100 == 0) { settings.feed_mm_per_tick = 0; }
    }
    return program;
}

struct RandomCase {
    PathSetup setup;
    TestProgram program;
};

inline RandomCase random_case(std::uint64_t seed) {
    Random random(seed);
    const std::size_t axes = 1 + random() % 4;
    const Ticks frame{random() % 3 == 0 ? 5'000 : 230'000};
    const PathSetup setup = setup_of(random_axes(random, axes), frame);
    return {setup, random_program(random, axes, random() % 2 == 0)};
}

}  // namespace lockstep
