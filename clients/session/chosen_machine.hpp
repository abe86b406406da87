// The machine of a command, and its file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "services/documents/edit/kept_settings.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

struct ChosenMachine {
    std::filesystem::path file;
    MachineSetup config;
    std::uint64_t hash = 0;        // of the configuration
    std::filesystem::path source;  // the file that people edit; senders keep settings beside it; empty if unknown
    KeptSettings settings;         // of senders; `config` contains them already
};

}  // namespace lockstep
