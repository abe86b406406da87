#include "clients/methods/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "clients/analysis/measure/speed_meter.hpp"

namespace lockstep::comparison {
namespace {

constexpr double kTicksPerSecond = 1e6;

void measure_errors(const std::vector<double>& ideal_s, Outcome& outcome) {
    const auto& times = outcome.train.times_s;
    double squares = 0;
    for (std::size_t i = 0; i < std::min(times.size(), ideal_s.size()); ++i) {
        const double error = (times[i] - ideal_s[i]) * 1e6;
        outcome.errors_us.push_back(error);
        squares += error * error;
        if (std::abs(error) > std::abs(outcome.largest_error_us)) { outcome.largest_error_us = error; }
    }
    outcome.rms_error_us = std::sqrt(squares / static_cast<double>(outcome.errors_us.size()));
    outcome.duration_s = times.back();
    outcome.ratio = times.back() / ideal_s.back();
}

void measure_speed(Outcome& outcome) {
    analysis::SpeedMeter meter;
    for (const double time_s : outcome.train.times_s) {
        const auto sample = meter.step({Tick{std::llround(time_s * kTicksPerSecond)}, +1});
        if (!sample) { continue; }
        outcome.speed_time_s.push_back(static_cast<double>(sample->at.value) / kTicksPerSecond);
        outcome.speed.push_back(sample->value * kTicksPerSecond);
    }
    meter.interrupt();
    outcome.peak_speed = meter.peak_steps_per_tick() * kTicksPerSecond;
    const double acceleration = meter.peak_steps_per_tick2() * kTicksPerSecond * kTicksPerSecond;
    if (acceleration > 0) { outcome.peak_acceleration = acceleration; }
}

Row run(const StepMove& move, const Ideal& ideal, const methods::Method& method) {
    auto train = method.run(move, methods::Fit::Nearest);
    if (!train) { return {method, std::unexpected(text_of(train.error()))}; }
    Outcome outcome{.train = *std::move(train)};
    measure_errors(ideal.step_times_s(method.crossing), outcome);
    measure_speed(outcome);
    return {method, std::move(outcome)};
}

}  // namespace

Comparison compare(const StepMove& move, std::span<const methods::Method> methods) {
    const Ideal ideal(move);
    Comparison result{.move = move,
                      .ideal_s = ideal.duration_s(),
                      .ideal_peak = ideal.peak(),
                      .ideal = ideal.corners(),
                      .lines = line_deviations()};
    for (const methods::Method& method : methods) { result.rows.push_back(run(move, ideal, method)); }
    return result;
}

}  // namespace lockstep::comparison
