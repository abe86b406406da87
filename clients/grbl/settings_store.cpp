#include "clients/grbl/settings_store.hpp"

#include "services/documents/machine_file.hpp"
#include "services/documents/placement.hpp"
#include "services/files/text_file.hpp"

namespace lockstep::grbl {
namespace {

std::unexpected<Refused> not_kept(const std::string& why) { return std::unexpected(Refused{Error::NotKept, why}); }

}  // namespace

/// Loads the file again, because settings may have been written since the machine was brought up.
SettingsStore::SettingsStore(const ChosenMachine& machine) : source_(machine.source), next_(machine.config) {
    if (const auto loaded = load_machine(source_)) { next_ = loaded->config; }
}

std::expected<void, Refused> SettingsStore::keep(const KeptSettings& settings) {
    auto kept = read_settings(settings_file(source_));
    if (!kept) { return not_kept(to_text(settings_file(source_).string(), kept.error())); }
    for (const KeptSetting& setting : settings) { set(*kept, setting); }
    return write(*kept);
}

std::expected<void, Refused> SettingsStore::drop() { return write({}); }

std::expected<void, Refused> SettingsStore::write(const KeptSettings& settings) {
    if (source_.empty()) { return not_kept("the machine's file is not known: start lockstep-grbl with --machine"); }
    if (hosts_of(next_).size() > 1) {
        return not_kept("the machine is on several hosts, each with its own file: change it there");
    }
    const auto text = read_text_file(source_);
    if (!text) { return not_kept(to_text(source_.string(), text.error())); }
    const auto edited = with_settings(*text, settings);
    if (!edited) { return std::unexpected(Refused{Error::SettingOutOfRange, edited.error().front().message}); }
    const auto next = parse_machine(*edited);
    if (next) {
        if (const std::string why = why_without_effect(*next, settings); !why.empty()) {
            return std::unexpected(Refused{Error::SettingFixed, why});
        }
    }
    if (const auto written = write_settings(settings_file(source_), settings); !written) {
        return not_kept(written.error());
    }
    if (next) { next_ = *next; }
    return {};
}

}  // namespace lockstep::grbl
