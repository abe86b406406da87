#include "clients/supervisor/machine_choice.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "clients/supervisor/state_directory.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {

std::expected<std::filesystem::path, Failure> choose_file(const std::string& option, const char* environment,
                                                          const std::vector<std::filesystem::path>& up,
                                                          const std::filesystem::path& installed) {
    if (!option.empty()) { return option; }
    if (environment != nullptr && *environment != '\0') { return environment; }
    if (up.size() == 1) { return up.front(); }
    if (up.empty() && !installed.empty()) { return installed; }
    constexpr const char* kHow = "choose one: --machine FILE, or set LOCKSTEP_MACHINE=FILE";
    if (up.empty()) {
        return std::unexpected(bad_input("no machine is chosen, no machine is up on this host, and there is no " +
                                         std::string(kInstalledMachine) + "; " + kHow));
    }
    std::string names;
    for (const auto& file : up) { names += (names.empty() ? "" : ", ") + file.parent_path().filename().string(); }
    return std::unexpected(bad_input("several machines are up on this host (" + names + "); " + kHow));
}

std::filesystem::path installed_machine(const std::filesystem::path& file) {
    std::error_code error;
    const bool may_be_there = std::filesystem::exists(file, error) || error == std::errc::permission_denied;
    return may_be_there ? file : std::filesystem::path();
}

std::expected<ChosenMachine, Failure> read_machine(const std::filesystem::path& file) {
    const auto alone = load_machine_file(file);
    if (!alone) { return std::unexpected(bad_file(file.string(), alone.error())); }
    const StateDirectory state(alone->name);
    if (file == state.machine_file()) {
        const auto settings = read_settings(state.settings_in_force());
        return ChosenMachine{file, *alone, config_hash(*alone), state.source(), settings.value_or(KeptSettings{})};
    }
    std::error_code error;
    const std::filesystem::path source = std::filesystem::weakly_canonical(file, error);
    const bool is_up = state.source() == source && !state.running().empty();
    auto loaded = load_machine(file, is_up ? state.settings_in_force() : settings_file(file));
    if (!loaded) { return std::unexpected(bad_file(file.string(), loaded.error())); }
    const std::uint64_t hash = config_hash(loaded->config);
    return ChosenMachine{file, std::move(loaded->config), hash, source, std::move(loaded->settings)};
}

std::expected<ChosenMachine, Failure> choose_machine(const std::string& option) {
    std::vector<std::filesystem::path> up;
    for (const std::string& name : machines_up()) { up.push_back(StateDirectory(name).machine_file()); }
    auto file = choose_file(option, std::getenv("LOCKSTEP_MACHINE"), up, installed_machine());
    if (!file) { return std::unexpected(file.error()); }
    const StateDirectory lost(file->parent_path().filename().string());
    if (*file == lost.machine_file() && lost.is_lost()) {
        return std::unexpected(failed(fmt::format(
            "machine '{}' is up, but {}; name its configuration file with --machine FILE, or end it: lockstep down",
            file->parent_path().filename().string(),
            lost.record_trouble().value_or("its state directory is not there"))));
    }
    return read_machine(*file);
}

}  // namespace lockstep
