// The settings that senders write, in their file beside the machine's file.
#pragma once

#include <expected>
#include <filesystem>

#include "clients/grbl/protocol/errors.hpp"
#include "clients/session/chosen_machine.hpp"

namespace lockstep::grbl {

class SettingsStore {
public:
    explicit SettingsStore(const ChosenMachine& machine);

    /// The machine as it is when it is next brought up.
    const MachineConfig& next() const { return next_; }
    /// They are on the disk on return. Error: the machine cannot have them, or the file cannot be written; it is as it
    /// was.
    std::expected<void, Refused> keep(const KeptSettings& settings);
    /// Removes all of them.
    std::expected<void, Refused> drop();

private:
    std::expected<void, Refused> write(const KeptSettings& settings);

    std::filesystem::path source_;  // the machine's file
    MachineConfig next_;
};

}  // namespace lockstep::grbl
