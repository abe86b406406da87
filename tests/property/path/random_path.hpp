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
        if (random() % 100 == 0) { settings.feed_mm_per_tick.reset(); }
    }
    return program;
}

struct RandomCase {
    PathSetup setup;
    TestProgram program;
};

/// Some moves become arcs, helices and whole turns with the same ends, and some keep their feed with any override. The
/// radius of an arc changes by up to `spiral_mm`.
inline void bend(TestProgram& program, Random& random, double spiral_mm) {
    Place from(program.moves.front().to.size(), 0);
    for (TestMove& move : program.moves) {
        move.settings.is_feed_fixed = random() % 10 == 0;
        const std::size_t first = random() % from.size();
        const std::size_t second = (first + 1 + random() % (from.size() - 1)) % from.size();
        const double x = move.to[first] - from[first];
        const double y = move.to[second] - from[second];
        if (random() % 3 == 0 && std::hypot(x, y) > 0.01) {
            // Radii of 20 mm at most: programs of hours would only make tests slow.
            const double aside = log_uniform(random, 0.01, 20) / std::hypot(x, y) * (random() % 2 == 0 ? 1 : -1);
            move.arc = ArcShape{.first = first,
                                .second = second,
                                .centre_first_mm = from[first] + x / 2 - aside * y,
                                .centre_second_mm = from[second] + y / 2 + aside * x,
                                .is_clockwise = random() % 2 == 0,
                                .turns = random() % 10 == 0 ? 2 : 1};
        }
        if (move.arc && spiral_mm > 0) {
            move.arc->centre_first_mm += x / std::hypot(x, y) * log_uniform(random, 0.0001, spiral_mm) / 2;
            move.arc->centre_second_mm += y / std::hypot(x, y) * log_uniform(random, 0.0001, spiral_mm) / 2;
        }
        from = move.to;
    }
}

/// Programs from these seeds on have arcs; their radii change.
inline constexpr std::uint64_t kFirstWithArcs = 10'000;
inline constexpr std::uint64_t kFirstWithSpirals = 20'000;

inline RandomCase random_case(std::uint64_t seed) {
    Random random(seed);
    if (seed >= kFirstWithArcs) {
        const std::size_t axes = 2 + random() % 3;
        const Ticks frame{random() % 3 == 0 ? 5'000 : 230'000};
        RandomCase arcs{setup_of(random_axes(random, axes), frame), random_program(random, axes, random() % 2 == 0)};
        arcs.program.moves.resize(std::min<std::size_t>(arcs.program.moves.size(), 300));
        constexpr double kMostSpiral_mm = 0.0719;  // of a program in inches
        bend(arcs.program, random, seed >= kFirstWithSpirals ? kMostSpiral_mm : 0);
        return arcs;
    }
    const std::size_t axes = 1 + random() % 4;
    const Ticks frame{random() % 3 == 0 ? 5'000 : 230'000};
    const PathSetup setup = setup_of(random_axes(random, axes), frame);
    return {setup, random_program(random, axes, random() % 2 == 0)};
}

}  // namespace lockstep
