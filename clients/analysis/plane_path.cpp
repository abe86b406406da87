#include "clients/analysis/plane_path.hpp"

#include <algorithm>
#include <limits>
#include <ranges>
#include <utility>

#include "clients/analysis/line_distance.hpp"

namespace lockstep::analysis {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kEvenSamples = 20'000;  // of a stretch of time, beside the knots

/// Instants from `first` to `last`, both among them.
struct Stretch {
    Tick first;
    Tick last;
    bool holds(Tick tick) const { return first <= tick && tick <= last; }
};

struct PlaneAxis {
    const AxisLog& log;
    double mm_per_step = 0;
    std::size_t place = 0;  // in the trace's knots

    double mm_at(Tick tick) { return position_at(log.trace().knots(), tick, place) * mm_per_step; }
};

std::optional<PlaneAxis> plane_axis(const Analysis& analysis, const std::string& name) {
    for (const auto& log : analysis.axes) {
        const auto steps_per_mm = analysis.steps_per_mm(*log);
        if (log->name() != name || !steps_per_mm || log->trace().knots().empty()) { continue; }
        return PlaneAxis{*log, 1 / *steps_per_mm};
    }
    return std::nullopt;
}

void part(drawing::PlanePath& path) {
    if (path.x.empty()) { return; }
    path.x.push_back(kNone);
    path.y.push_back(kNone);
}

std::vector<PlanePoint> asked_points(const Program& program) {
    const auto x = static_cast<std::size_t>(std::ranges::find(program.axes, "X") - program.axes.begin());
    const auto y = static_cast<std::size_t>(std::ranges::find(program.axes, "Y") - program.axes.begin());
    if (x == program.axes.size() || y == program.axes.size()) { return {}; }
    std::vector<PlanePoint> points = {{program.start_mm.at(x), program.start_mm.at(y)}};
    for (const Block& block : program.blocks) {
        if (const auto* move = std::get_if<LinearMove>(&block.action)) {
            points.push_back({move->target_mm.at(x), move->target_mm.at(y)});
        }
    }
    return points;
}

/// A job without an end is over when the next begins.
Stretch stretch_of(const JobLog& job, const Analysis& analysis) {
    const auto tick_at = [&](std::int64_t microseconds) {
        return Tick{static_cast<std::int64_t>(Int128{microseconds} * 1000 / analysis.tick_ns())};
    };
    Stretch stretch{*analysis.first_tick(), *analysis.last_tick()};
    if (job.first_frame) {
        stretch.first = *job.first_frame;
    } else if (job.begun_us) {
        stretch.first = tick_at(*job.begun_us);
    }
    const JobLog* next = &job + 1 < analysis.jobs.data() + analysis.jobs.size() ? &job + 1 : nullptr;
    const auto ended_us = job.ended_us || next == nullptr ? job.ended_us : next->begun_us;
    if (ended_us) { stretch.last = std::min(stretch.last, tick_at(*ended_us)); }
    return stretch;
}

void add_knots(const AxisLog& log, const Stretch& stretch, std::vector<Tick>& instants) {
    for (const Knot& knot : log.trace().knots()) {
        if (stretch.holds(knot.tick)) { instants.push_back(knot.tick); }
    }
}

/// Every knot's instant, and others at even intervals.
std::vector<Tick> instants_in(const Stretch& stretch, const PlaneAxis& x, const PlaneAxis& y) {
    std::vector<Tick> instants;
    if (stretch.last < stretch.first) { return instants; }
    add_knots(x.log, stretch, instants);
    add_knots(y.log, stretch, instants);
    const std::int64_t apart = std::max<std::int64_t>(1, (stretch.last - stretch.first).value / kEvenSamples);
    for (Tick at = stretch.first; at < stretch.last; at += Ticks{apart}) { instants.push_back(at); }
    instants.push_back(stretch.last);
    std::ranges::sort(instants);
    return instants;
}

bool is_missing(const AxisLog& log, Tick tick) {
    return std::ranges::any_of(log.statistics().breaks(), [&](const Break& what) {
        return what.missing_batches > 0 && what.from && *what.from < tick && what.to && tick < *what.to;
    });
}

void add_stepped(const Stretch& stretch, PlaneAxis x, PlaneAxis y, drawing::PlanePath& path) {
    part(path);
    bool parted = true;
    for (const Tick tick : instants_in(stretch, x, y)) {
        if (is_missing(x.log, tick) || is_missing(y.log, tick)) {
            if (!std::exchange(parted, true)) { part(path); }
            continue;
        }
        path.x.push_back(x.mm_at(tick));
        path.y.push_back(y.mm_at(tick));
        parted = false;
    }
}

void add_asked(const std::vector<PlanePoint>& points, drawing::PlanePath& path) {
    part(path);
    for (const PlanePoint& point : points) {
        path.x.push_back(point.x);
        path.y.push_back(point.y);
    }
}

/// Of the points from `first` on.
double largest_distance(const drawing::PlanePath& stepped, std::size_t first, const std::vector<PlanePoint>& points) {
    NearestLine asked;
    asked.add(points);
    double largest = 0;
    for (std::size_t i = first; i < stepped.x.size(); ++i) {
        if (stepped.x[i] == stepped.x[i]) { largest = std::max(largest, asked.distance({stepped.x[i], stepped.y[i]})); }
    }
    return largest;
}

}  // namespace

std::optional<PlaneComparison> compare_in_plane(const Analysis& analysis) {
    const auto x = plane_axis(analysis, "X");
    const auto y = plane_axis(analysis, "Y");
    if (!x || !y) { return std::nullopt; }
    PlaneComparison result;
    for (const JobLog& job : analysis.jobs) {
        const bool has_line = job.program && job.kind != "own-move";  // axes on their own are asked for no line
        const auto points = has_line ? asked_points(*job.program) : std::vector<PlanePoint>{};
        if (points.size() < 2) { continue; }
        const std::size_t before = result.stepped.x.size();
        add_asked(points, result.asked);
        add_stepped(stretch_of(job, analysis), *x, *y, result.stepped);
        if (result.stepped.x.size() == before) { continue; }
        const double here = largest_distance(result.stepped, before, points);
        result.largest_distance_mm = std::max(result.largest_distance_mm.value_or(0), here);
    }
    if (result.asked.x.empty()) {
        add_stepped({*analysis.first_tick(), *analysis.last_tick()}, *x, *y, result.stepped);
    }
    return result;
}

}  // namespace lockstep::analysis
