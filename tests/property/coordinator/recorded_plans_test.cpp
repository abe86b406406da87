// Plans by Lai's method, and estimated times of programs, stay as recorded. To write the files:
// LOCKSTEP_WRITE_HASHES=1 build/bin/property_coordinator --gtest_filter='*StayAsRecorded'
#include <cmath>

#include "core/coordinator/path/lai_path.hpp"
#include "core/coordinator/program/block_times.hpp"
#include "tests/property/draw_below.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/property/recorded_text.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kPaths = 60;
constexpr std::uint32_t kPrograms = 600;

/// The pulses per period are whole numbers, or a little more or less.
AxisLimits draw_lai_limits(Random& random, std::int64_t tick_ns) {
    const double period = static_cast<double>(kLaiPeriod_ns) / static_cast<double>(tick_ns);
    const auto near = [&](std::int64_t pulses) {
        return static_cast<double>(pulses) + static_cast<double>(draw_below(random, 3) - 1) / 8;
    };
    AxisLimits limits;
    limits.start_velocity = near(3 + draw_below(random, 3)) / period;
    limits.max_velocity = limits.start_velocity + near(1 + draw_below(random, 60)) / period;
    limits.max_acceleration = near(3 + draw_below(random, 6)) / period / period;
    limits.max_deceleration =
        one_in(random, 2) ? limits.max_acceleration : near(3 + draw_below(random, 6)) / period / period;
    limits.min_steps = -1'000'000;
    limits.max_steps = 1'000'000;
    return limits;
}

void record(RecordedText& text, const Path& path) {
    for (const PathMove& move : path.moves) {
        text.line(move.block, move.part, move.from, move.to, move.lead, move.length_mm, move.start, move.profile,
                  move.dwell);
    }
}

/// A path, the rest of it after a hold within a period, and the way to rest from some instants.
std::string lai_path_of(std::uint32_t number) {
    Random random(number);
    const std::int64_t tick_ns = one_in(random, 3) ? 500 : 1000;
    const std::size_t axes = 2 + random() % 2;
    std::vector<AxisLimits> limits;
    std::vector<double> steps_per_mm;
    for (std::size_t i = 0; i < axes; ++i) {
        limits.push_back(draw_lai_limits(random, tick_ns));
        steps_per_mm.push_back(static_cast<double>(20 + draw_below(random, 400)));
    }
    std::vector<PathMove> moves;
    AxisCounts at;
    for (std::size_t i = 0; i < axes; ++i) { at.append(0); }
    RecordedText text;
    for (std::uint32_t block = 1; block <= 4; ++block) {
        AxisCounts to = at;
        const std::int64_t size = one_in(random, 2) ? 30 : 3000;
        for (std::size_t i = 0; i < axes; ++i) { to[i] += draw_below(random, 2 * size + 1) - size; }
        const auto feed =
            one_in(random, 2) ? std::nullopt : std::optional(1e-6 * static_cast<double>(draw_below(random, 50)));
        const PathMove move = make_move(at, to, limits, steps_per_mm, feed);
        const auto checked = check_lai_move(move, tick_ns);
        text.line(checked.has_value(), checked ? 0 : checked.error());
        if (!checked || move.lead == 0) { continue; }
        moves.push_back(move);
        moves.back().block = block;
        at = to;
    }
    if (moves.empty()) { return text.text(); }
    const auto following = one_in(random, 4) ? LaiFollowing::AsPublished : LaiFollowing::OnTheLine;
    const Path path = plan_lai_path(moves, {}, limits, steps_per_mm, tick_ns, Ticks{400}, following);
    record(text, path);
    Path rest;
    for (int k = 0; k < 6; ++k) {
        const Subticks now{draw_below(random, path.duration().value)};
        brake_from(path, now, limits, rest);
        record(text, rest);
        const std::size_t held = path.move_at(now);
        const std::vector<PathMove> left(path.moves.begin() + static_cast<std::ptrdiff_t>(held), path.moves.end());
        record(text, plan_lai_path(left, left.front().along_at(now), limits, steps_per_mm, tick_ns, Ticks{400}));
    }
    return text.text();
}

MachineConfig draw_machine_with(Random& random, std::size_t axes) {
    MachineConfig machine{.name = "drawn"};
    for (std::size_t i = 0; i < axes; ++i) {
        machine.axes.push_back({.name = std::string(1, "XYZ"[i]),
                                .steps_per_mm = 100,
                                .start_velocity_mm_s = 5,
                                .max_velocity_mm_s = static_cast<double>(10 + draw_below(random, 100)),
                                .max_accel_mm_s2 = static_cast<double>(50 + draw_below(random, 2000)),
                                .max_decel_mm_s2 = static_cast<double>(50 + draw_below(random, 2000)),
                                .position_max_mm = 1000});
    }
    return machine;
}

/// Moves in few directions, so that many are joined without a corner, or with a blunt one.
std::vector<double> draw_way(Random& random, std::size_t axes) {
    std::vector<double> way;
    const double length = std::ldexp(1.0, static_cast<int>(draw_below(random, 10)) - 4);
    for (std::size_t i = 0; i < axes; ++i) { way.push_back(length * static_cast<double>(draw_below(random, 4) - 1)); }
    return way;
}

void add_block(Random& random, std::size_t axes, BlockTimes& times) {
    const auto feed =
        one_in(random, 3) ? std::nullopt : std::optional(static_cast<double>(1 + draw_below(random, 120)));
    const std::int64_t kind = draw_below(random, 12);
    if (kind == 0) { return times.add_rest(); }
    if (kind == 1) { return times.add_dwell(static_cast<double>(draw_below(random, 20)) / 8); }
    if (kind > 3 || axes < 2) { return times.add_move(draw_way(random, axes), feed); }
    const double radius = static_cast<double>(1 + draw_below(random, 30));
    ArcShape shape{.centre_first_mm = radius, .is_clockwise = one_in(random, 2)};
    shape.turns = 1 + static_cast<std::int32_t>(draw_below(random, 3));
    const std::vector<double> from(axes, 0);
    std::vector<double> to(axes, one_in(random, 2) ? 0 : 4);
    to[0] = one_in(random, 3) ? 0 : 2 * radius;
    to[1] = 0;
    const ArcPath arc(shape, from, to);
    times.add_arc(arc, {0, 1}, to, feed);
}

std::string times_of(std::uint32_t number) {
    Random random(number);
    const std::size_t axes = 1 + random() % 3;
    BlockTimes times(draw_machine_with(random, axes));
    const std::uint32_t blocks = 1 + static_cast<std::uint32_t>(draw_below(random, 60));
    RecordedText text;
    for (std::uint32_t n = 0; n < blocks; ++n) {
        add_block(random, axes, times);
        text.line(times.seconds());
    }
    times.add_rest();
    for (std::uint32_t n = 0; n <= blocks; ++n) {
        text.line(times.seconds_from({n, {}}), times.seconds_from({n, Displacement::steps(draw_below(random, 4))}));
    }
    return text.text();
}

TEST(PathsByLai, StayAsRecorded) { expect_recorded("tests/property/coordinator/lai_paths.txt", kPaths, lai_path_of); }
TEST(TimesOfBlocks, StayAsRecorded) {
    expect_recorded("tests/property/coordinator/block_times.txt", kPrograms, times_of);
}

}  // namespace
}  // namespace lockstep
