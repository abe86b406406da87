#include "clients/analysis/channel_curves.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "clients/text/event_text.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep::analysis {
namespace {

using ChannelKind = ChannelEvent::Kind;

constexpr double kPercent = 100;
constexpr double kShownAfter_s = 1;  // changes after the last step

/// Only its channel.
ChannelChange channel_of(const ChannelCourse& course) {
    return {.at = {}, .motor = course.motor(), .kind = course.kind(), .channel = course.channel()};
}

bool is_shown(const Analysis& analysis, const ChannelCourse& course) {
    return !analysis.config || name_of(channel_of(course), *analysis.config);
}

std::optional<std::array<std::string, 2>> levels_of(ChannelKind kind) {
    if (kind == ChannelKind::Analog) { return std::nullopt; }
    if (kind == ChannelKind::Input) { return std::array<std::string, 2>{"open", "closed"}; }
    return std::array<std::string, 2>{"off", "on"};
}

drawing::Point between(drawing::Point a, drawing::Point b, double x) {
    const double share = b.x > a.x ? (x - a.x) / (b.x - a.x) : 1;
    return {x, a.y + (b.y - a.y) * share};
}

/// The part of a curve from 0 to `end`, in seconds.
void clip(std::vector<drawing::Point>& points, double end) {
    std::vector<drawing::Point> kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_within = points[i].x >= 0 && points[i].x <= end;
        const bool enters = i > 0 && points[i - 1].x < 0 && points[i].x > 0;
        const bool leaves = i > 0 && points[i - 1].x < end && points[i].x > end;
        if (enters) { kept.push_back(between(points[i - 1], points[i], 0)); }
        if (leaves) { kept.push_back(between(points[i - 1], points[i], end)); }
        if (is_within) { kept.push_back(points[i]); }
    }
    points = std::move(kept);
}

/// Breaks the curve where it is not known.
void add_points(const std::vector<drawing::Point>& points, drawing::AxisCurve& curve) {
    std::size_t next = 0;
    for (const drawing::Point& point : points) {
        for (; next < curve.missing.size() && curve.missing[next].from < point.x; ++next) {
            curve.time_s.push_back(curve.missing[next].from);
            curve.value.push_back(std::numeric_limits<double>::quiet_NaN());
        }
        curve.time_s.push_back(point.x);
        curve.value.push_back(point.y);
    }
}

void note_missing(const Analysis& analysis, const ChannelCourse& course, double end, std::vector<drawing::Span>& out) {
    for (const UnknownTime& time : course.unknown()) {
        const double from = std::max(0.0, analysis.seconds_at(time.from));
        const double to = std::min(end, analysis.seconds_at(time.to));
        if (from < to) { out.push_back({from, to}); }
    }
}

void note_asked(const Analysis& analysis, const OutputConfig& output, ChannelCurve& out) {
    for (const HappenedEvent& event : analysis.program_events) {
        if (!is_switched_by(output, event.event)) { continue; }
        out.asked_s.push_back(analysis.seconds_at(event.at));
        out.asked.push_back(event_words(event.event));
    }
}

ChannelCurve curve_of(const Analysis& analysis, const ChannelCourse& course, double end) {
    ChannelCurve out{.curve = {}, .levels = levels_of(course.kind()), .asked_s = {}, .asked = {}};
    out.curve.axis = channel_text(channel_of(course), analysis.config ? &*analysis.config : nullptr);
    out.curve.unit = out.levels ? "level" : "%";
    note_missing(analysis, course, end, out.curve.missing);
    std::vector<drawing::Point> points;
    const double scale = out.levels ? 1 : kPercent;
    for (const drawing::Point& point : course.points()) {
        const Ticks after{static_cast<std::int64_t>(point.x)};
        points.push_back({analysis.seconds_at(course.origin() + after), point.y * scale});
    }
    clip(points, end);
    add_points(points, out.curve);
    const OutputConfig* output = analysis.config ? output_of(channel_of(course), *analysis.config) : nullptr;
    if (output != nullptr) { note_asked(analysis, *output, out); }
    return out;
}

}  // namespace

double shown_seconds(const Analysis& analysis) {
    if (!analysis.first_tick()) { return 0; }
    const double motion = analysis.seconds_at(*analysis.last_tick());
    double shown = motion;
    for (const ChannelCourse& course : analysis.channel_courses) {
        if (course.kind() == ChannelKind::Input || !is_shown(analysis, course)) { continue; }
        shown = std::max(shown, std::min(analysis.seconds_at(course.last_change()), motion + kShownAfter_s));
    }
    return shown;
}

std::vector<ChannelCurve> channel_curves(const Analysis& analysis) {
    std::vector<ChannelCurve> curves;
    const double end = shown_seconds(analysis);
    for (const ChannelCourse& course : analysis.channel_courses) {
        if (is_shown(analysis, course)) { curves.push_back(curve_of(analysis, course, end)); }
    }
    return curves;
}

}  // namespace lockstep::analysis
