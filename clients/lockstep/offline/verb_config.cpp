// lockstep config
#include <algorithm>
#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/supervisor/edit_machine.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "idl/proto/report.pb.h"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

struct ConfigOptions {
    std::string file;
    bool fold = false;
    bool json = false;
};

/// `machine`: the configuration from its file alone, without kept settings.
proto::SettingsReport report_of(const ChosenMachine& chosen, const MachineConfig& machine, const KeptSettings& kept) {
    proto::SettingsReport report;
    report.set_file(chosen.source.string());
    for (const KeptSetting& setting : kept) {
        proto::SettingReport& entry = *report.add_settings();
        entry.set_axis(setting.axis);
        entry.set_key(setting.key);
        entry.set_value(setting.value);
        const auto axis = std::ranges::find(machine.axes, setting.axis, &AxisConfig::name);
        if (axis != machine.axes.end()) { entry.set_in_file(value_of(*axis, setting.key)); }
        entry.set_applies(std::ranges::find(chosen.settings, setting) != chosen.settings.end());
    }
    return report;
}

void print(const proto::SettingsReport& report, Output& output) {
    if (report.settings().empty()) { return output.print(report.file() + ": no settings are kept beside it"); }
    output.print(report.file() + ": settings that a sender has written apply instead");
    for (const proto::SettingReport& setting : report.settings()) {
        output.print("  " + setting.axis() + "." + setting.key() + ": " + setting.value() + "; in the file " +
                     setting.in_file() + (setting.applies() ? "" : "; it applies after: lockstep down; lockstep up"));
    }
    output.print(report.folded() ? "written into the file" : "next: lockstep config --fold writes them into the file");
}

/// Writes the machine's file first. If interrupted before the settings are removed, the machine's values are the same.
std::expected<void, Failure> fold(const std::filesystem::path& file, const KeptSettings& kept) {
    auto written = edit_machine(file, [&](std::string_view text) { return with_settings(text, kept); });
    if (!written) { return written; }
    const auto removed = write_settings(settings_file(file), {});
    return removed ? written : std::unexpected(failed(removed.error()));
}

ExitCode config(const ConfigOptions& options) {
    Output output(options.json);
    const auto chosen = choose_machine(options.file);
    if (!chosen) { return output.fail(chosen.error()); }
    if (chosen->source.empty()) { return output.fail(bad_input("the machine's own file is not known; name it")); }
    const std::string file = chosen->source.string();
    const auto machine = load_machine_file(chosen->source);
    if (!machine) { return output.fail(bad_file(file, machine.error())); }
    const auto kept = read_settings(settings_file(chosen->source));
    if (!kept) { return output.fail(bad_file(settings_file(chosen->source).string(), kept.error())); }
    proto::SettingsReport report = report_of(*chosen, *machine, *kept);
    if (options.fold && !kept->empty()) {
        if (const auto done = fold(chosen->source, *kept); !done) { return output.fail(done.error()); }
        report.set_folded(true);
    }
    output.report(report);
    print(report, output);
    return kExitDone;
}

}  // namespace

void add_config(Verb command) {
    const Verb verb = command.add_verb("config",
                                       "show the settings that senders have written\n"
                                       "These settings apply instead of those in the machine's file.");
    const auto options = std::make_shared<ConfigOptions>();
    verb.add_option("file", options->file, "the machine's configuration file; default: the file that other verbs use");
    verb.add_flag("--fold", options->fold,
                  "write the settings into the file and remove FILE.settings; the rest of the file, also its comments, "
                  "does not change");
    add_json(verb, options->json);
    verb.footer(
        "Senders of grbl's protocol write settings such as $110=3000 (lockstep-grbl). They are kept in FILE.settings,\n"
        "beside the machine's file, and apply after: lockstep down; lockstep up.\n" +
        footer("  lockstep config\n  lockstep config mill.textproto --fold\n"));
    verb.action([options] { return config(*options); });
}

}  // namespace lockstep
