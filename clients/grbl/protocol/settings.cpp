#include "clients/grbl/protocol/settings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace lockstep::grbl {
namespace {

constexpr std::size_t kMostAxes = 6;
constexpr double kSame = 0.0005;  // of a value that is written with three digits

std::string number(double value, int digits) {
    char text[400];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

/// The axes that home towards their lower end.
int homing_mask(const MachineConfig& machine) {
    int mask = 0;
    for (std::size_t i = 0; i < std::min(machine.axes.size(), kMostAxes); ++i) {
        if (machine.axes[i].homing.toward_min) { mask |= 1 << i; }
    }
    return mask;
}

void add_axes(const MachineConfig& machine, int first, const char* key, double (*value_of)(const AxisConfig&),
              std::vector<Setting>& settings) {
    for (std::size_t i = 0; i < std::min(machine.axes.size(), kMostAxes); ++i) {
        settings.push_back({first + static_cast<int>(i), number(value_of(machine.axes[i]), 3),
                            "axis " + machine.axes[i].name + ": " + key});
    }
}

}  // namespace

std::vector<Setting> settings_of(const MachineConfig& machine, const ReportOptions& options) {
    const HomingConfig& homing = machine.axes.front().homing;
    std::vector<Setting> settings{
        {0, "10", ""},
        {1, "255", ""},
        {2, "0", ""},
        {3, "0", ""},
        {4, "0", ""},
        {5, "0", ""},
        {6, "0", ""},
        {10, std::to_string(options.mask), "the connection"},
        {11, "0.000", ""},
        {12, "0.001", ""},
        {13, options.inches ? "1" : "0", "the connection"},
        {20, "1", ""},
        {21, "1", ""},
        {22, "1", ""},
        {23, std::to_string(homing_mask(machine)), "homing.toward_min"},
        {24, number(homing.latch_velocity_mm_s * 60, 3), "homing.latch_velocity_mm_s"},
        {25, number(homing.search_velocity_mm_s * 60, 3), "homing.search_velocity_mm_s"},
        {26, "0", ""},
        {27, number(homing.pulloff_mm, 3), "homing.pulloff_mm"},
        {30, "1000", ""},
        {31, "0", ""},
        {32, "0", ""},
    };
    add_axes(
        machine, 100, "steps_per_mm", [](const AxisConfig& axis) { return axis.steps_per_mm; }, settings);
    add_axes(
        machine, 110, "max_velocity_mm_s", [](const AxisConfig& axis) { return axis.max_velocity_mm_s * 60; },
        settings);
    add_axes(
        machine, 120, "max_accel_mm_s2", [](const AxisConfig& axis) { return axis.max_accel_mm_s2; }, settings);
    add_axes(
        machine, 130, "position_min_mm, position_max_mm",
        [](const AxisConfig& axis) { return axis.position_max_mm - axis.position_min_mm; }, settings);
    return settings;
}

std::expected<void, std::string> write_setting(const MachineConfig& machine, int number, double value,
                                               ReportOptions& options) {
    const auto settings = settings_of(machine, options);
    const auto found = std::ranges::find(settings, number, &Setting::number);
    if (found == settings.end()) { return std::unexpected("there is no $" + std::to_string(number)); }
    if (number == 10) {
        options.mask = static_cast<int>(std::clamp(value, 0.0, 255.0));
        return {};
    }
    if (number == 13) {
        options.inches = value != 0;
        return {};
    }
    if (std::abs(std::strtod(found->value.c_str(), nullptr) - value) <= kSame) { return {}; }
    if (found->source.empty()) {
        return std::unexpected("$" + std::to_string(number) + " is always " + found->value + " here");
    }
    return std::unexpected("$" + std::to_string(number) + " is " + found->value + " by the machine's file (" +
                           found->source + "): change it there and restart the machine");
}

}  // namespace lockstep::grbl
