#include "clients/analysis/curves.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/axis_unit.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep::analysis {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// An axis's curve, and the factors that convert its ticks and steps to seconds and lengths.
struct Scaled {
    drawing::AxisCurve curve;
    double length_per_step = 1;
    double ticks_per_s = 1;
    Tick origin;

    double seconds(Tick tick) const { return static_cast<double>((tick - origin).value) / ticks_per_s; }
    void add(Tick tick, double value) {
        curve.time_s.push_back(seconds(tick));
        curve.value.push_back(value);
    }
};

/// Whether the axis is known to rest after its last step in the log.
bool is_end_known(const AxisLog& axis) { return axis.unrecorded_steps() == 0; }

Scaled scaled(const Analysis& analysis, const AxisLog& axis) {
    const auto steps_per_mm = analysis.steps_per_mm(axis);
    Scaled out{.origin = analysis.first_tick().value_or(Tick{})};
    out.curve.axis = axis.name();
    out.curve.unit = steps_per_mm ? analysis.unit_of(axis.name()) : "steps";
    out.length_per_step = steps_per_mm ? 1 / *steps_per_mm : 1;
    out.ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    for (const Break& what : axis.statistics().breaks()) {
        if (what.missing_batches == 0 || !what.from || !what.to) { continue; }
        out.curve.missing.push_back({out.seconds(*what.from), out.seconds(*what.to)});
    }
    return out;
}

/// Adds samples of a quantity, and a break where steps are missing.
void add_samples(const std::vector<Sample>& samples, double scale, Scaled& out) {
    const auto& gaps = out.curve.missing;
    std::size_t next_gap = 0;
    for (const Sample& sample : samples) {
        for (; next_gap < gaps.size() && gaps[next_gap].from <= out.seconds(sample.at); ++next_gap) {
            out.add(sample.at, kNone);
        }
        out.add(sample.at, sample.value * scale);
    }
}

/// Ends a curve of motion: with rest, or with a gap if the log lacks steps after the axis's last one.
void add_end(const Analysis& analysis, const AxisLog& axis, double value_at_rest, Scaled& out) {
    if (is_end_known(axis)) { return out.add(*analysis.last_tick(), value_at_rest); }
    out.curve.missing.push_back({out.seconds(axis.statistics().last()->tick), out.seconds(*analysis.last_tick())});
}

/// If the log lacks steps after the axis's last one, the axis does not rest there, but moves on at an unknown speed.
std::vector<Sample> known_speed(const AxisLog& axis) {
    std::vector<Sample> samples = axis.statistics().speed();
    if (is_end_known(axis)) { return samples; }
    const Tick last = axis.statistics().last()->tick;
    std::erase_if(samples, [&](const Sample& sample) { return sample.at >= last; });
    if (!samples.empty()) { samples.push_back({last, samples.back().value}); }
    return samples;
}

drawing::AxisCurve speed_curve(const Analysis& analysis, const AxisLog& axis) {
    Scaled out = scaled(analysis, axis);
    if (const MotorConfig* config = analysis.motor_config(axis.name())) { out.curve.limit = config->max_velocity_mm_s; }
    if (!axis.statistics().first()) { return std::move(out.curve); }
    out.add(*analysis.first_tick(), 0);
    add_samples(known_speed(axis), out.ticks_per_s * out.length_per_step, out);
    add_end(analysis, axis, 0, out);
    return std::move(out.curve);
}

drawing::AxisCurve position_curve(const Analysis& analysis, const AxisLog& axis) {
    Scaled out = scaled(analysis, axis);
    const auto& knots = axis.trace().knots();
    if (knots.empty()) { return std::move(out.curve); }
    out.add(*analysis.first_tick(), knots.front().position_steps * out.length_per_step);
    for (std::size_t i = 0; i < knots.size(); ++i) {
        if (i > 0 && !knots[i].joined) { out.add(knots[i].tick, kNone); }
        out.add(knots[i].tick, knots[i].position_steps * out.length_per_step);
    }
    add_end(analysis, axis, knots.back().position_steps * out.length_per_step, out);
    return std::move(out.curve);
}

drawing::AxisCurve acceleration_curve(const Analysis& analysis, const AxisLog& axis) {
    Scaled out = scaled(analysis, axis);
    if (const MotorConfig* config = analysis.motor_config(axis.name())) { out.curve.limit = config->max_accel_mm_s2; }
    add_samples(axis.statistics().acceleration(), out.ticks_per_s * out.ticks_per_s * out.length_per_step, out);
    return std::move(out.curve);
}

drawing::AxisCurve lateness_curve(const Analysis& analysis, const AxisLog& axis) {
    Scaled out = scaled(analysis, axis);
    out.curve.unit = "us";
    add_samples(axis.late_course(), 1e6 / out.ticks_per_s, out);
    return std::move(out.curve);
}

drawing::AxisCurve slack_curve(const Analysis& analysis, const AxisLog& axis) {
    Scaled out = scaled(analysis, axis);
    out.curve.unit = "ms";
    add_samples(axis.slack(), 1, out);
    return std::move(out.curve);
}

std::vector<drawing::AxisCurve> curves(const Analysis& analysis,
                                       drawing::AxisCurve (*of)(const Analysis&, const AxisLog&)) {
    std::vector<drawing::AxisCurve> all;
    for (const auto& axis : analysis.axes) {
        if (analysis.is_board(axis->name()) && of != slack_curve) { continue; }  // it does not move
        drawing::AxisCurve curve = of(analysis, *axis);
        if (!analysis.has_motors_as_axes()) { curve.axis = analysis.label_of(curve.axis); }
        all.push_back(std::move(curve));
    }
    return all;
}

/// A quantity of the axes that have no motor of their own, before that of the motors.
struct AxisQuantity {
    std::vector<Sample> AxisFigures::*samples;
    int per_s = 0;                        // 1: per second, 2: per second squared
    double AxisConfig::*limit = nullptr;  // null: none
};

std::vector<drawing::AxisCurve> with_axes(const Analysis& analysis, const AxisQuantity& quantity,
                                          drawing::AxisCurve (*of)(const Analysis&, const AxisLog&)) {
    std::vector<drawing::AxisCurve> all;
    const double ticks_per_s = 1e9 / static_cast<double>(analysis.tick_ns());
    for (const AxisFigures& axis : analysis.axis_figures) {
        if (analysis.motor_config(axis.name) != nullptr && analysis.label_of(axis.name).starts_with("axis")) {
            continue;
        }
        Scaled out{.ticks_per_s = ticks_per_s, .origin = analysis.first_tick().value_or(Tick{})};
        out.curve.axis = "axis " + axis.name;
        out.curve.unit = lockstep::unit_of(axis.name);
        const AxisConfig* config = analysis.axis_config(axis.name);
        if (config != nullptr && quantity.limit != nullptr) { out.curve.limit = config->*quantity.limit; }
        add_samples(axis.*quantity.samples, std::pow(ticks_per_s, quantity.per_s), out);
        all.push_back(std::move(out.curve));
    }
    std::ranges::move(curves(analysis, of), std::back_inserter(all));
    return all;
}

}  // namespace

std::vector<drawing::AxisCurve> speed_curves(const Analysis& analysis) {
    return with_axes(analysis, {&AxisFigures::speed, 1, &AxisConfig::max_velocity_mm_s}, speed_curve);
}

std::vector<drawing::AxisCurve> position_curves(const Analysis& analysis) {
    return with_axes(analysis, {&AxisFigures::position}, position_curve);
}

std::vector<drawing::AxisCurve> acceleration_curves(const Analysis& analysis) {
    return with_axes(analysis, {&AxisFigures::acceleration, 2, &AxisConfig::max_accel_mm_s2}, acceleration_curve);
}

std::vector<drawing::AxisCurve> lateness_curves(const Analysis& analysis) { return curves(analysis, lateness_curve); }

std::vector<drawing::AxisCurve> slack_curves(const Analysis& analysis) { return curves(analysis, slack_curve); }

}  // namespace lockstep::analysis
