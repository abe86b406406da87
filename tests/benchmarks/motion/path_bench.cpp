// The cost of a dense path per line of its program: geometry alone, geometry and look-ahead, and all up to frames.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "core/path/path_planner.hpp"

namespace lockstep {
namespace {

PathSetup mill() {
    const auto axis = [](double steps_per_mm, double start, double top, double a) {
        return AxisLimits{.start_velocity = start * steps_per_mm * 1e-6,
                          .max_velocity = top * steps_per_mm * 1e-6,
                          .max_acceleration = a * steps_per_mm * 1e-12,
                          .max_deceleration = a * steps_per_mm * 1e-12,
                          .min_steps = -(std::int64_t{1} << 40),
                          .max_steps = std::int64_t{1} << 40};
    };
    return {{axis(80, 10, 150, 1500), axis(80, 10, 150, 1500), axis(400, 4, 25, 300)}, {80, 80, 400}, Ticks{230'000}};
}

enum class Kind : std::uint8_t { Line, Circle, Spline, DenseRandom, Random };

constexpr int kLines = 100'000;

double thousandth(double mm) { return std::round(mm * 1000) / 1000; }

std::vector<std::vector<double>> program(Kind kind) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<> unit(0, 1);
    std::vector<std::vector<double>> places;
    double x = 0;
    double y = 0;
    double heading = 0;
    for (int k = 1; k <= kLines; ++k) {
        const double s = 0.01 * k;
        double z = 0;
        if (kind == Kind::Line) {
            x = 0.8 * s;
            y = 0.6 * s;
        } else if (kind == Kind::Circle) {
            x = 20 * std::cos(s / 4) - 20;
            y = 20 * std::sin(s / 4);
        } else if (kind == Kind::Spline) {
            x = 30 * std::sin(s / 30) + 5 * std::sin(s / 6);
            y = 30 * std::cos(s / 30) - 30 + 5 * std::sin(s / 10);
            z = 2 * std::sin(s / 15);
        } else {
            const double length = kind == Kind::DenseRandom ? 0.01 : 0.05 + 0.95 * unit(random);
            heading += (2 * unit(random) - 1) * 0.4;
            x += length * std::cos(heading);
            y += length * std::sin(heading);
        }
        places.push_back({thousandth(x), thousandth(y), thousandth(z)});
    }
    return places;
}

void per_line(benchmark::State& state) {
    state.counters["time_per_line"] = benchmark::Counter(static_cast<double>(state.iterations()) * kLines,
                                                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

constexpr MoveSettings kSettings{.feed_mm_per_tick = 100e-6};

void Geometry(benchmark::State& state) {
    const auto places = program(static_cast<Kind>(state.range(0)));
    const PathSetup setup = mill();
    for (auto _ : state) {
        PathTrail trail;
        ChordJoiner joiner(setup);
        joiner.begin(PlaceVector::zeros(3));
        for (const auto& place : places) {
            joiner.add(setup.to_steps(place), kSettings, 1, trail);
            benchmark::DoNotOptimize(trail.end());
            trail.drop_before(trail.end());
        }
    }
    per_line(state);
}
BENCHMARK(Geometry)->Name("path/geometry")->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

void LookAhead(benchmark::State& state) {
    const auto places = program(static_cast<Kind>(state.range(0)));
    const PathSetup setup = mill();
    for (auto _ : state) {
        PathTrail trail;
        ChordJoiner joiner(setup);
        SpeedWindow window(setup);
        joiner.begin(PlaceVector::zeros(3));
        for (const auto& place : places) {
            joiner.add(setup.to_steps(place), kSettings, 1, trail);
            for (std::size_t k = trail.first(); k < trail.end(); ++k) { window.add(trail.piece(k)); }
            trail.drop_before(trail.end());
            window.drop_before(window.known());
        }
        benchmark::DoNotOptimize(window.end());
    }
    per_line(state);
}
BENCHMARK(LookAhead)->Name("path/geometry_and_look_ahead")->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

void Frames(benchmark::State& state) {
    const auto places = program(static_cast<Kind>(state.range(0)));
    const PathSetup setup = mill();
    std::size_t waiting = 0;
    for (auto _ : state) {
        PathPlanner planner(setup);
        planner.begin(std::vector<Position>(3));
        std::uint32_t block = 0;
        for (const auto& place : places) {
            planner.line({place}, kSettings, ++block);
            while (true) {
                const auto frame = planner.next();
                if (!frame || !*frame) { break; }
                benchmark::DoNotOptimize((*frame)->ticks);
            }
            waiting = std::max(waiting, planner.waiting());
        }
    }
    per_line(state);
    state.counters["most_waiting"] = static_cast<double>(waiting);
}
BENCHMARK(Frames)->Name("path/frames")->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lockstep
