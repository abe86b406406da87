#include "services/documents/edit/kept_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/number_text.hpp"
#include "core/parse_number.hpp"
#include "services/documents/edit/key_edit.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/text/trimmed.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHeader =
    "# Settings that a sender has written. They apply instead of the values in the machine's file.\n"
    "# lockstep config shows them, lockstep config --fold writes them into that file.\n";
constexpr std::string_view kSwitch = "homing.toward_min";

struct Key {
    std::string_view name;
    double (*value)(const AxisConfig&);
};
constexpr std::array<Key, 9> kKeys{{
    {"steps_per_mm", steps_per_mm_of},
    {"max_velocity_mm_s", [](const AxisConfig& axis) { return axis.max_velocity_mm_s; }},
    {"max_accel_mm_s2", [](const AxisConfig& axis) { return axis.max_accel_mm_s2; }},
    {"position_min_mm", [](const AxisConfig& axis) { return axis.position_min_mm; }},
    {"position_max_mm", [](const AxisConfig& axis) { return axis.position_max_mm; }},
    {kSwitch, [](const AxisConfig& axis) { return axis.homing.toward_min ? 1.0 : 0.0; }},
    {"homing.search_velocity_mm_s", [](const AxisConfig& axis) { return axis.homing.search_velocity_mm_s; }},
    {"homing.latch_velocity_mm_s", [](const AxisConfig& axis) { return axis.homing.latch_velocity_mm_s; }},
    {"homing.pulloff_mm", [](const AxisConfig& axis) { return axis.homing.pulloff_mm; }},
}};

bool is_value(std::string_view key, std::string_view text) {
    if (key == kSwitch) { return text == "true" || text == "false"; }
    const auto value = parse_number<double>(text);
    return value && std::isfinite(*value);
}

std::optional<KeptSetting> setting_of(std::string_view line) {
    const std::size_t point = line.find('.');
    const std::size_t colon = line.find(':');
    if (point == line.npos || colon == line.npos || colon < point) { return std::nullopt; }
    const std::string_view key = trimmed(line.substr(point + 1, colon - point - 1));
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (std::ranges::find(kKeys, key, &Key::name) == kKeys.end() || !is_value(key, value)) { return std::nullopt; }
    return KeptSetting{std::string(line.substr(0, point)), std::string(key), std::string(value)};
}

std::string line_of(const KeptSetting& setting) { return setting.axis + "." + setting.key + ": " + setting.value; }

std::unexpected<Diagnostics> refusal(const std::string& message) {
    return std::unexpected(Diagnostics{{.message = message}});
}

/// Removes the places from the errors, because they refer to an edited text that no file contains.
std::unexpected<Diagnostics> without_places(Diagnostics errors) {
    for (Diagnostic& error : errors) { error.line = error.column = 0; }
    return std::unexpected(std::move(errors));
}

/// Names the settings' file in the errors, because the caller names only the machine's file.
std::unexpected<Diagnostics> of_file(const fs::path& settings, const Diagnostics& errors) {
    Diagnostics named;
    for (const Diagnostic& error : errors) {
        const std::string line = error.line > 0 ? fmt::format(", line {}", error.line) : "";
        named.push_back({.message = fmt::format("with the settings in {}{}: {}; correct or remove that file",
                                                settings.string(), line, error.message)});
    }
    return std::unexpected(named);
}

}  // namespace

std::string value_text(double value) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

double steps_per_mm_of(const AxisConfig& axis) {
    return axis.motors.empty() ? axis.steps_per_mm : axis.motors.front().steps_per_mm.value_or(axis.steps_per_mm);
}

std::string value_of(const AxisConfig& axis, std::string_view key) {
    const auto found = std::ranges::find(kKeys, key, &Key::name);
    if (found == kKeys.end()) { return {}; }
    const double value = found->value(axis);
    return key == kSwitch ? (value != 0 ? "true" : "false") : value_text(value);
}

fs::path settings_file(const fs::path& machine_file) {
    std::error_code error;
    const fs::path found = fs::canonical(machine_file, error);
    return (error ? machine_file : found).string() + ".settings";
}

void set(KeptSettings& settings, const KeptSetting& setting) {
    const auto same = std::ranges::find_if(
        settings, [&](const KeptSetting& other) { return other.axis == setting.axis && other.key == setting.key; });
    same == settings.end() ? settings.push_back(setting) : void(*same = setting);
}

std::string settings_text(const KeptSettings& settings) {
    std::string text(kHeader);
    for (const KeptSetting& setting : settings) { text += line_of(setting) + "\n"; }
    return text;
}

std::expected<KeptSettings, Diagnostics> settings_from_text(std::string_view text) {
    KeptSettings settings;
    Diagnostics errors;
    for (int number = 1; !text.empty(); ++number) {
        const std::string_view line = trimmed(text.substr(0, text.find('\n')));
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
        if (line.empty() || line.starts_with('#')) { continue; }
        const auto setting = setting_of(line);
        if (!setting) {
            errors.push_back({.line = number,
                              .column = 1,
                              .message = "'" + std::string(line) + "' is not a setting; write AXIS.KEY: VALUE"});
            continue;
        }
        set(settings, *setting);
    }
    if (!errors.empty()) { return std::unexpected(errors); }
    return settings;
}

std::expected<KeptSettings, Diagnostics> read_settings(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error) && !error) { return KeptSettings{}; }
    const auto text = read_text_file(file);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    return settings_from_text(*text);
}

std::expected<void, std::string> write_settings(const fs::path& file, const KeptSettings& settings) {
    if (!settings.empty()) { return replace_text_file(file, settings_text(settings)); }
    std::error_code error;
    fs::remove(file, error);
    if (error) { return std::unexpected(file.string() + ": cannot be removed: " + error.message()); }
    return {};
}

std::expected<std::string, Diagnostics> with_settings(std::string_view text, const KeptSettings& settings) {
    const auto machine = parse_machine(text);
    if (!machine) { return std::unexpected(machine.error()); }
    std::string edited(text);
    for (const KeptSetting& setting : settings) {
        const auto axis = std::ranges::find(machine->axes, setting.axis, &AxisConfig::name);
        if (axis == machine->axes.end()) { return refusal("the machine has no axis " + setting.axis); }
        const std::string block = fmt::format("axis[{}].", axis - machine->axes.begin());
        if (!set_key(edited, block + setting.key, setting.value)) {
            return refusal(line_of(setting) +
                           " cannot be written: a comment is between the key and its value in "
                           "the machine's file; move it");
        }
    }
    const auto result = parse_machine(edited);
    if (!result) { return without_places(result.error()); }
    return edited;
}

std::string why_without_effect(const MachineSetup& machine, const KeptSettings& settings) {
    for (const KeptSetting& setting : settings) {
        const auto axis = std::ranges::find(machine.axes, setting.axis, &AxisConfig::name);
        if (setting.key != "steps_per_mm" || axis == machine.axes.end()) { continue; }
        const double written = std::strtod(setting.value.c_str(), nullptr);
        for (const MotorBlock& motor : axis->motors) {
            if (motor.steps_per_mm.value_or(written) == written) { continue; }
            return fmt::format("motor {} has its own steps_per_mm, {}, in the machine's file: change it there",
                               motor.name, number_text(*motor.steps_per_mm));
        }
    }
    return "";
}

std::expected<LoadedMachine, Diagnostics> load_machine(const fs::path& file) {
    return load_machine(file, settings_file(file));
}

std::expected<LoadedMachine, Diagnostics> load_machine(const fs::path& file, const fs::path& settings) {
    auto machine = load_machine_file(file);
    if (!machine) { return std::unexpected(machine.error()); }
    auto kept = read_settings(settings);
    if (!kept) { return of_file(settings, kept.error()); }
    if (kept->empty()) { return LoadedMachine{*std::move(machine), {}}; }
    const auto text = read_text_file(file);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    const auto edited = with_settings(*text, *kept);
    if (!edited) { return of_file(settings, edited.error()); }
    machine = parse_machine(*edited);
    if (!machine) { return std::unexpected(machine.error()); }
    return LoadedMachine{*std::move(machine), *std::move(kept)};
}

std::string settings_notice(const KeptSettings& settings) {
    std::string text;
    for (const KeptSetting& setting : settings) { text += (text.empty() ? "" : ", ") + line_of(setting); }
    return "settings that a sender has written apply instead of the machine's file: " + text;
}

}  // namespace lockstep
