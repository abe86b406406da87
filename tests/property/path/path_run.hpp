// Runs a program through the path planner, and checks its frames against the program and the limits of the axes. The
// checks use the integers of the frames only.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "core/if_positive.hpp"
#include "core/path/path_planner.hpp"

namespace lockstep {

using Random = std::mt19937_64;
using Place = std::vector<double>;  // mm

inline double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
}
inline double log_uniform(Random& random, double low, double high) {
    return low * std::pow(high / low, uniform(random, 0, 1));
}

/// mm and s; the tick is 1 us.
struct TestAxis {
    double steps_per_mm = 80;
    double start_velocity = 10;
    double max_velocity = 150;
    double acceleration = 1500;
    double deceleration = 1500;
};

inline PathSetup setup_of(const std::vector<TestAxis>& axes, Ticks frame = Ticks{230'000}) {
    PathSetup setup{.limits = {}, .steps_per_mm = {}, .frame_ticks = frame};
    for (const TestAxis& axis : axes) {
        const double scale = axis.steps_per_mm;
        setup.steps_per_mm.push_back(scale);
        setup.limits.push_back({.start_velocity = axis.start_velocity * scale * 1e-6,
                                .max_velocity = std::min(axis.max_velocity * scale * 1e-6, 0.45),
                                .max_acceleration = axis.acceleration * scale * 1e-12,
                                .max_deceleration = axis.deceleration * scale * 1e-12,
                                .min_steps = -(std::int64_t{1} << 40),
                                .max_steps = std::int64_t{1} << 40});
    }
    return setup;
}

/// Two belts and a screw, as in the example machines.
inline std::vector<TestAxis> mill() { return {{}, {}, {400, 4, 25, 300, 300}}; }

struct TestMove {
    Place to;
    MoveSettings settings;
    std::optional<ArcShape> arc = {};
};

inline void give(PathPlanner& planner, const TestMove& move, std::uint32_t block) {
    move.arc ? planner.arc({*move.arc, move.to}, move.settings, block) : planner.line({move.to}, move.settings, block);
}

/// The chords of an arc, of a hundredth of a radian at most, or the end of a line.
inline std::vector<Place> chords_of(const TestMove& move, const Place& from) {
    if (!move.arc) { return {move.to}; }
    const ArcShape& arc = *move.arc;
    const double x = from[arc.first] - arc.centre_first_mm;
    const double y = from[arc.second] - arc.centre_second_mm;
    const double end_x = move.to[arc.first] - arc.centre_first_mm;
    const double end_y = move.to[arc.second] - arc.centre_second_mm;
    const double sense = arc.is_clockwise ? -1 : 1;
    double sweep = sense * (std::atan2(end_y, end_x) - std::atan2(y, x));
    while (sweep <= 1e-9) { sweep += 2 * std::numbers::pi; }
    while (sweep > 2 * std::numbers::pi + 1e-9) { sweep -= 2 * std::numbers::pi; }
    sweep += 2 * std::numbers::pi * (arc.turns - 1);
    const double radius = std::hypot(x, y);
    const int chords = 1 + static_cast<int>(sweep * 100 * std::sqrt(std::max(radius, 1.0)));
    std::vector<Place> places;
    for (int k = 1; k <= chords; ++k) {
        const double share = static_cast<double>(k) / chords;
        Place at = from;
        for (std::size_t i = 0; i < at.size(); ++i) { at[i] += share * (move.to[i] - from[i]); }
        const double r = radius + share * (std::hypot(end_x, end_y) - radius);
        const double angle = std::atan2(y, x) + sense * share * sweep;
        at[arc.first] = arc.centre_first_mm + r * std::cos(angle);
        at[arc.second] = arc.centre_second_mm + r * std::sin(angle);
        places.push_back(at);
    }
    return places;
}

struct TestProgram {
    std::vector<TestMove> moves;

    void add(Place to, double feed_mm_s) {
        moves.push_back({std::move(to), {.feed_mm_per_tick = if_positive(feed_mm_s * 1e-6)}});
    }
    /// The places of the program from the start on, in steps.
    std::vector<Place> polyline(const PathSetup& setup) const {
        std::vector<Place> places{Place(setup.axes(), 0)};
        Place from(setup.axes(), 0);
        for (const TestMove& move : moves) {
            for (Place at : chords_of(move, from)) {
                for (std::size_t i = 0; i < setup.axes(); ++i) { at[i] *= setup.steps_per_mm[i]; }
                places.push_back(std::move(at));
            }
            from = move.to;
        }
        return places;
    }
};

struct PathRun {
    std::vector<PathFrame> frames;
    std::vector<Position> from;  // where it begins; empty: at 0
    std::int64_t slowed = 0;     // frames made again
    std::int64_t braked = 0;     // frames that go along the tail before them
    std::size_t most_waiting = 0;

    double seconds() const {
        std::int64_t ticks = 0;
        for (const PathFrame& frame : frames) { ticks += frame.ticks.value; }
        return static_cast<double>(ticks) * 1e-6;
    }
    double pieces_per_s() const {
        std::size_t pieces = 0;
        for (const PathFrame& frame : frames) { pieces += frame.axes[0].body.size(); }
        return static_cast<double>(pieces) / seconds();
    }
};

inline void drain(PathPlanner& planner, PathRun& run) {
    while (!planner.is_done()) {
        auto frame = planner.next();
        ASSERT_TRUE(frame) << "stuck in block " << frame.error().at.block;
        if (!*frame) { break; }
        run.frames.push_back(std::move(**frame));
    }
    run.most_waiting = std::max(run.most_waiting, planner.waiting());
    run.slowed = planner.counts().slowed;
    run.braked = planner.counts().braked;
}

/// Plans the program. Takes frames behind move k if `drains(k)` is true.
inline PathRun run_path(
    const PathSetup& setup, const TestProgram& program,
    const std::function<bool(std::size_t)>& drains = [](std::size_t) { return true; }) {
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(setup.axes()));
    PathRun run;
    for (std::size_t k = 0; k < program.moves.size(); ++k) {
        const TestMove& move = program.moves[k];
        give(planner, move, static_cast<std::uint32_t>(k + 1));
        if (drains(k)) { drain(planner, run); }
    }
    planner.finish();
    drain(planner, run);
    EXPECT_TRUE(planner.is_done());
    return run;
}

/// Checks that over any time the speed of one axis changes by at most start velocity + acceleration * time. Speed is
/// linear within a piece, so the ends of pieces are enough.
class SpeedWatch {
public:
    explicit SpeedWatch(const AxisLimits& limits)
        : limits_(limits), steepest_(std::max(limits.max_acceleration, limits.max_deceleration)) {}

    void follow(const Piece& piece) {
        const double n = static_cast<double>(piece.ticks.value);
        const double first = static_cast<double>((piece.covered(Ticks{1})).as_steps());
        const double last = (piece.covered() - piece.covered(piece.ticks - Ticks{1})).as_steps();
        const double a = n > 1 ? (last - first) / (n - 1) : 0;
        const double v0 = first - a / 2;
        const double v1 = last + a / 2;
        ASSERT_GT(piece.ticks.value, 0);
        ASSERT_LE(std::max(std::abs(v0), std::abs(v1)), limits_.max_velocity * (1 + 1e-5) + 2 * steepest_);
        const double most = std::abs(v1) > std::abs(v0) ? limits_.max_acceleration : limits_.max_deceleration;
        ASSERT_LE(std::abs(a), most * (1 + 1e-4) + 1e-13) << "over " << n << " ticks";
        at(v0);
        ticks_ += n;
        at(v1);
    }
    void at(double v) {
        const double paid = steepest_ * (1 + 1e-5) * ticks_;
        const double slack = limits_.start_velocity * (1 + 1e-5) + kTicks * steepest_;
        ASSERT_LE(v - paid, lowest_ + slack) << "at tick " << ticks_;
        ASSERT_GE(v + paid, highest_ - slack) << "at tick " << ticks_;
        lowest_ = std::min(lowest_, v - paid);
        highest_ = std::max(highest_, v + paid);
    }

private:
    /// Pieces meet at whole ticks, for which axes tolerate two ticks' acceleration. A piece of one tick counts here
    /// with its mean speed at both ends, which is half a tick's acceleration off at each end.
    static constexpr double kTicks = 3;

    AxisLimits limits_;
    double steepest_;
    double ticks_ = 0;
    double lowest_ = 0;   // of speed - acceleration * time, from rest
    double highest_ = 0;  // of speed + acceleration * time
};

/// Frames follow each other bit by bit, keep the limits, and every tail leads to rest.
inline void expect_within_limits(const PathSetup& setup, const PathRun& run) {
    for (std::size_t i = 0; i < setup.motors(); ++i) {
        SpeedWatch watch(setup.limits[i]);
        Position at = run.from.empty() ? Position{} : run.from[i];
        for (std::size_t k = 0; k < run.frames.size(); ++k) {
            const PathFrame& frame = run.frames[k];
            const AxisTrack& track = frame.axes[i];
            ASSERT_EQ(track.from, at) << "frame " << k;
            ASSERT_EQ(total_ticks(track.body), frame.ticks);
            for (const Piece& piece : track.body) {
                ASSERT_NO_FATAL_FAILURE(watch.follow(piece)) << "frame " << k << " axis " << i;
                at = at + piece.covered();
            }
            SpeedWatch stop = watch;
            for (const Piece& piece : track.tail) {
                ASSERT_NO_FATAL_FAILURE(stop.follow(piece)) << "tail " << k << " axis " << i;
            }
            ASSERT_NO_FATAL_FAILURE(stop.at(0)) << "tail " << k << " axis " << i;
            ASSERT_EQ(frame.last, k + 1 == run.frames.size());
        }
    }
}

/// The distance of p from the segment a to b: the greatest distance of an axis, at the point where it is least. The
/// function is convex, so a ternary search finds the least.
inline double distance(const Place& p, const Place& a, const Place& b) {
    const auto at = [&](double share) {
        double most = 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            most = std::max(most, std::abs(p[i] - a[i] - (b[i] - a[i]) * share));
        }
        return most;
    };
    double low = 0;
    double high = 1;
    for (int n = 0; n < 40; ++n) {
        const double third = (high - low) / 3;
        const bool is_left = at(low + third) < at(high - third);
        (is_left ? high : low) = is_left ? high - third : low + third;
    }
    return at((low + high) / 2);
}

/// Whether the segment a to b has a point within `most` of p in every axis. Each axis leaves an interval of the
/// segment.
inline bool is_near(const Place& p, const Place& a, const Place& b, double most) {
    double first = 0;
    double last = 1;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double length = b[i] - a[i];
        if (length == 0) {
            if (std::abs(p[i] - a[i]) > most) { return false; }
            continue;
        }
        const double middle = (p[i] - a[i]) / length;
        const double half = most / std::abs(length);
        first = std::max(first, middle - half);
        last = std::min(last, middle + half);
    }
    return first <= last;
}

/// Returns the first point that does not follow the path in order within `most` steps of every axis, or nullopt. Each
/// point takes the earliest possible segment, which leaves the most of the path to the points behind it.
inline std::optional<std::size_t> first_astray(const std::vector<Place>& points, const std::vector<Place>& path,
                                               double most) {
    std::size_t at = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        while (at + 1 < path.size() && !is_near(points[p], path[at], path[at + 1], most)) { ++at; }
        if (at + 1 == path.size()) { return p; }
    }
    return std::nullopt;
}

/// The places of the axes, in steps, at most `every` ticks apart.
inline std::vector<Place> samples_of(const PathRun& run, std::int64_t every) {
    std::vector<Place> places;
    for (const PathFrame& frame : run.frames) {
        std::vector<Position> at;
        for (const AxisTrack& track : frame.axes) { at.push_back(track.from); }
        for (std::size_t p = 0; p < frame.axes[0].body.size(); ++p) {
            const std::int64_t ticks = frame.axes[0].body[p].ticks.value;
            for (std::int64_t t = 0; t < ticks; t += every) {
                Place place;
                for (std::size_t i = 0; i < at.size(); ++i) {
                    place.push_back((at[i] + frame.axes[i].body[p].covered(Ticks{t})).as_steps());
                }
                places.push_back(place);
            }
            for (std::size_t i = 0; i < at.size(); ++i) { at[i] = at[i] + frame.axes[i].body[p].covered(); }
        }
        if (frame.last) {
            Place place;
            for (const Position& position : at) { place.push_back(position.as_steps()); }
            places.push_back(place);
        }
    }
    return places;
}

}  // namespace lockstep
