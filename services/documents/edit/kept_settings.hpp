// Settings of a machine that a G-code sender has written. They are keys of axes that apply instead of those in the
// machine's file. A separate file beside that file has one setting in each line, such as "X.homing.pulloff_mm: 2",
// until they are folded into the machine's file.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "services/files/diagnostic.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

struct KeptSetting {
    std::string axis;
    std::string key;    // key of the axis, such as "homing.pulloff_mm"
    std::string value;  // as in the machine's file
    bool operator==(const KeptSetting&) const = default;
};

using KeptSettings = std::vector<KeptSetting>;

/// Returns the number as in a machine's file, without loss.
std::string value_text(double value);
/// steps_per_mm of the first motor of the axis. The axis itself may be counted in finer steps.
double steps_per_mm_of(const AxisConfig& axis);
/// Returns an axis's value of a key; empty if this key may not be kept.
std::string value_of(const AxisConfig& axis, std::string_view key);

/// Names a motor that has its own value of a key that is set for its axis; empty if there is none. `machine`: with the
/// settings.
std::string why_without_effect(const MachineSetup& machine, const KeptSettings& settings);

/// Returns "mill.textproto.settings" beside "mill.textproto". If `machine_file` is a link, the name is that of the
/// link's target.
std::filesystem::path settings_file(const std::filesystem::path& machine_file);

/// Adds the setting, or replaces the one of the same axis and key.
void set(KeptSettings& settings, const KeptSetting& setting);

std::string settings_text(const KeptSettings& settings);
std::expected<KeptSettings, Diagnostics> settings_from_text(std::string_view text);
/// Returns no settings if the file does not exist.
std::expected<KeptSettings, Diagnostics> read_settings(const std::filesystem::path& file);
/// Removes the file if there are no settings. Error: the file and the reason; the file is unchanged.
std::expected<void, std::string> write_settings(const std::filesystem::path& file, const KeptSettings& settings);

/// Returns the text of a machine's file with these values. Everything else stays, including comments. Error: what is
/// wrong with the text, or with the machine that it would describe, by the rules for every machine's file.
std::expected<std::string, Diagnostics> with_settings(std::string_view text, const KeptSettings& settings);

/// A machine described by its file and the settings beside it.
struct LoadedMachine {
    MachineSetup config;
    KeptSettings settings;
};
std::expected<LoadedMachine, Diagnostics> load_machine(const std::filesystem::path& file);
/// Does the same with the settings of another file.
std::expected<LoadedMachine, Diagnostics> load_machine(const std::filesystem::path& file,
                                                       const std::filesystem::path& settings);

/// Returns a sentence for the log.
std::string settings_notice(const KeptSettings& settings);

}  // namespace lockstep
