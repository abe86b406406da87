// Stores the settings that senders write, in a separate file beside the machine's file.
#pragma once

#include <expected>
#include <filesystem>

#include "clients/grbl/protocol/errors.hpp"
#include "clients/session/chosen_machine.hpp"

namespace lockstep::grbl {

class SettingsStore {
public:
    explicit SettingsStore(const ChosenMachine& machine);

    /// The configuration that the machine will have when it is next brought up.
    const MachineSetup& next() const { return next_; }
    /// The settings are on the disk on return. If the machine cannot have them or the file cannot be written, returns
    /// an error and leaves the file unchanged.
    std::expected<void, Refused> keep(const KeptSettings& settings);
    /// Removes all settings.
    std::expected<void, Refused> drop();

private:
    std::expected<void, Refused> write(const KeptSettings& settings);

    std::filesystem::path source_;  // the machine's file
    MachineSetup next_;
};

}  // namespace lockstep::grbl
