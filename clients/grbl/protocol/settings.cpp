#include "clients/grbl/protocol/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "clients/grbl/protocol/number.hpp"

namespace lockstep::grbl {
namespace {

constexpr std::size_t kMostAxes = 6;
constexpr double kSame = 0.0005;  // tolerance of a value written with three digits
constexpr int kHomingMask = 23;
constexpr int kSteps = 100;
constexpr int kTravel = 130;

/// Why no single value is that of all motors of the axis; empty if one is.
std::string why_steps_differ(const AxisConfig& axis) {
    const auto has_same = [&](const MotorBlock& motor) {
        return motor.steps_per_mm.value_or(axis.steps_per_mm) == steps_per_mm_of(axis);
    };
    if (std::ranges::all_of(axis.motors, has_same)) { return ""; }
    std::string text = "the motors of axis " + axis.name + " have steps_per_mm of their own:";
    for (const MotorBlock& motor : axis.motors) {
        text += (&motor == &axis.motors.front() ? " " : ", ") + motor.name + " " +
                number(motor.steps_per_mm.value_or(axis.steps_per_mm), 3);
    }
    return text + "; change the machine's file";
}

/// Settings with a number for each axis, from `first` on, or with one number for all axes.
struct AxisKey {
    int first = 0;
    bool is_of_all = false;
    const char* key;
    double factor = 1;  // grbl's value / value in the machine's file
    double (*value)(const AxisConfig&);
};
constexpr std::array<AxisKey, 6> kAxisKeys{{
    {24, true, "homing.latch_velocity_mm_s", 60,
     [](const AxisConfig& axis) { return axis.homing.latch_velocity_mm_s; }},
    {25, true, "homing.search_velocity_mm_s", 60,
     [](const AxisConfig& axis) { return axis.homing.search_velocity_mm_s; }},
    {27, true, "homing.pulloff_mm", 1, [](const AxisConfig& axis) { return axis.homing.pulloff_mm; }},
    {kSteps, false, "steps_per_mm", 1, steps_per_mm_of},
    {110, false, "max_velocity_mm_s", 60, [](const AxisConfig& axis) { return axis.max_velocity_mm_s; }},
    {120, false, "max_accel_mm_s2", 1, [](const AxisConfig& axis) { return axis.max_accel_mm_s2; }},
}};

std::size_t axes_of(const MachineConfig& machine) { return std::min(machine.axes.size(), kMostAxes); }

/// A bit for each axis that homes towards its lower end.
int homing_mask(const MachineConfig& machine) {
    int mask = 0;
    for (std::size_t i = 0; i < axes_of(machine); ++i) {
        if (machine.axes[i].homing.toward_min) { mask |= 1 << i; }
    }
    return mask;
}

double travel_of(const AxisConfig& axis) { return axis.position_max_mm - axis.position_min_mm; }

Refused out_of_range(int number, const std::string& range) {
    return {Error::SettingOutOfRange, fmt::format("${} must be {}", number, range)};
}

std::expected<KeptSettings, Refused> write_homing_mask(const MachineConfig& machine, double value) {
    const int all = (1 << axes_of(machine)) - 1;
    if (value != std::floor(value) || value > all) {
        return std::unexpected(out_of_range(kHomingMask, fmt::format("a whole number from 0 to {}", all)));
    }
    KeptSettings settings;
    for (std::size_t i = 0; i < axes_of(machine); ++i) {
        const bool toward_min = ((static_cast<int>(value) >> i) & 1) != 0;
        if (toward_min == machine.axes[i].homing.toward_min) { continue; }
        settings.push_back({machine.axes[i].name, "homing.toward_min", toward_min ? "true" : "false"});
    }
    return settings;
}

/// Changes the travel's length. The end with the switch keeps its position.
KeptSetting travel_setting(const AxisConfig& axis, double length_mm) {
    if (axis.homing.toward_min) { return {axis.name, "position_max_mm", value_text(axis.position_min_mm + length_mm)}; }
    return {axis.name, "position_min_mm", value_text(axis.position_max_mm - length_mm)};
}

/// `number`: a setting of the machine that may be written.
std::expected<KeptSettings, Refused> keys_for(const MachineConfig& machine, int number, double value) {
    if (number == kHomingMask) { return write_homing_mask(machine, value); }
    if (number >= kTravel) {
        return KeptSettings{travel_setting(machine.axes[static_cast<std::size_t>(number - kTravel)], value)};
    }
    KeptSettings settings;
    for (const AxisKey& key : kAxisKeys) {
        for (const AxisIndex i : axis_indices(machine.axes.size())) {
            if (number != key.first + (key.is_of_all ? 0 : static_cast<int>(i))) { continue; }
            settings.push_back({machine.axes[i].name, key.key, value_text(value / key.factor)});
        }
    }
    return settings;
}

}  // namespace

std::vector<Setting> settings_of(const MachineConfig& machine, const ReportOptions& options) {
    constexpr const char* kSignals = "the device behind the axis has its own signals";
    constexpr const char* kSpindle = "the machine has no spindle";
    std::vector<Setting> settings{
        {0, "10", "the device behind the axis has its own pulses"},
        {1, "255", "the motors stay on"},
        {2, "0", kSignals},
        {3, "0", kSignals},
        {4, "0", kSignals},
        {5, "0", kSignals},
        {6, "0", "there is no probe"},
        {10, std::to_string(options.mask), ""},
        {11, "0.000", "corners are planned by start_velocity_mm_s of the axes"},
        {12, "0.001", "arcs are as close as a step of the axes"},
        {13, options.inches ? "1" : "0", ""},
        {20, "1", "the travel is always checked"},
        {21, "1", "limit switches are always checked"},
        {22, "1", "an axis is always homed before programs move it"},
        {kHomingMask, std::to_string(homing_mask(machine)), ""},
        {26, "0", "a switch is touched twice instead"},
        {30, "1000", kSpindle},
        {31, "0", kSpindle},
        {32, "0", kSpindle},
    };
    for (const AxisKey& key : kAxisKeys) {
        for (std::size_t i = 0; i < (key.is_of_all ? 1 : axes_of(machine)); ++i) {
            settings.push_back({key.first + static_cast<int>(i), number(key.value(machine.axes[i]) * key.factor, 3),
                                key.first == kSteps ? why_steps_differ(machine.axes[i]) : ""});
        }
    }
    for (std::size_t i = 0; i < axes_of(machine); ++i) {
        settings.push_back({kTravel + static_cast<int>(i), number(travel_of(machine.axes[i]), 3), ""});
    }
    std::ranges::sort(settings, {}, &Setting::number);
    return settings;
}

std::expected<KeptSettings, Refused> write_setting(const MachineConfig& machine, int number, double value,
                                                   ReportOptions& options) {
    const auto settings = settings_of(machine, options);
    const auto found = std::ranges::find(settings, number, &Setting::number);
    const std::string name = fmt::format("${}", number);
    if (found == settings.end()) { return std::unexpected(Refused{Error::UnknownCommand, "there is no " + name}); }
    if (value < 0) { return std::unexpected(Refused{Error::NegativeValue, {}}); }
    if (number == 10) {
        options.mask = static_cast<int>(std::min(value, 255.0));
        return {};
    }
    if (number == 13) {
        options.inches = value != 0;
        return {};
    }
    if (std::abs(std::strtod(found->value.c_str(), nullptr) - value) <= kSame) { return {}; }
    if (found->why_fixed.empty()) { return keys_for(machine, number, value); }
    return std::unexpected(Refused{
        Error::SettingFixed, fmt::format("{} is always {} on this machine: {}", name, found->value, found->why_fixed)});
}

}  // namespace lockstep::grbl
