#include "clients/methods/lines.hpp"

#include <algorithm>

#include "core/methods/lai.hpp"

namespace lockstep::comparison {
namespace {

using methods::LaiPoint;
using methods::LaiPulses;
using methods::PeriodPulses;

constexpr std::int64_t kTo = 5;  // (5, 5)

PeriodPulses length(std::int64_t from_x, std::int64_t pulses_per_unit) {
    return {(kTo - from_x) * pulses_per_unit, kTo * pulses_per_unit};
}

/// The greatest pulse rate of y, the longer axis of every line, from the shortest time between two of its pulses.
double peak_rate(const std::vector<LaiPoint>& points) {
    std::int64_t shortest = methods::kDdaClocks;
    const LaiPoint* before = nullptr;
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i].y == points[i - 1].y) { continue; }
        if (before != nullptr) { shortest = std::min(shortest, points[i].clock - before->clock); }
        before = &points[i];
    }
    return methods::kDdaClocks / (methods::LaiParameters{}.period_s * static_cast<double>(shortest));
}

LineDeviation deviation(std::int64_t from_x) {
    const PeriodPulses end = length(from_x, kPulsesPerUnit);
    const auto with = walk_line(from_x, kPulsesPerUnit, LaiPulses::Spread);
    const auto without = walk_line(from_x, kPulsesPerUnit, LaiPulses::AtOnce);
    return {.from_x = from_x,
            .with_dda = farthest_from_line(with, end),
            .without_dda = farthest_from_line(without, end),
            .rate_with_dda = peak_rate(with),
            .rate_without_dda = peak_rate(without)};
}

}  // namespace

std::vector<LaiPoint> walk_line(std::int64_t from_x, std::int64_t pulses_per_unit, LaiPulses how) {
    return walk_two_axes(plan_two_axes(length(from_x, pulses_per_unit), {}, methods::LaiRounding::FromTheStart, {}),
                         how);
}

std::vector<LineDeviation> line_deviations() {
    std::vector<LineDeviation> lines;
    for (std::int64_t from_x = 0; from_x < kLines; ++from_x) { lines.push_back(deviation(from_x)); }
    return lines;
}

}  // namespace lockstep::comparison
