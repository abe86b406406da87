// Settings of a machine that a sender has written: keys of axes that apply instead of those in the machine's file. They
// are in a file of their own beside it, one in each line, "X.homing.pulloff_mm: 2", until they are folded into it.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

struct KeptSetting {
    std::string axis;
    std::string key;    // of the axis: "max_velocity_mm_s", "homing.pulloff_mm"
    std::string value;  // as in the machine's file
    bool operator==(const KeptSetting&) const = default;
};

using KeptSettings = std::vector<KeptSetting>;

/// As it is written in a machine's file, without loss.
std::string value_text(double value);
/// Of an axis. Empty: the key is none of those that may be kept.
std::string value_of(const AxisConfig& axis, std::string_view key);

/// "mill.textproto.settings", beside "mill.textproto". Under the file's own name, where a link leads to it.
std::filesystem::path settings_file(const std::filesystem::path& machine_file);

/// Replaces the value of the same key.
void set(KeptSettings& settings, const KeptSetting& setting);

std::string settings_text(const KeptSettings& settings);
std::expected<KeptSettings, Diagnostics> settings_from_text(std::string_view text);
/// None, without the file.
std::expected<KeptSettings, Diagnostics> read_settings(const std::filesystem::path& file);
/// Without settings the file is removed. Error: the file, and why; it is as it was.
std::expected<void, std::string> write_settings(const std::filesystem::path& file, const KeptSettings& settings);

/// The text of a machine's file with these values. Everything else stays, comments too. Error: what is wrong with the
/// text, or with the machine that it would describe, by the rules for every machine's file.
std::expected<std::string, Diagnostics> with_settings(std::string_view text, const KeptSettings& settings);

/// A machine as its file and the settings beside it describe it.
struct LoadedMachine {
    MachineConfig config;
    KeptSettings settings;
};
std::expected<LoadedMachine, Diagnostics> load_machine(const std::filesystem::path& file);
/// The same with the settings of another file.
std::expected<LoadedMachine, Diagnostics> load_machine(const std::filesystem::path& file,
                                                       const std::filesystem::path& settings);

/// A sentence for a log.
std::string settings_notice(const KeptSettings& settings);

}  // namespace lockstep
