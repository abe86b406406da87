// The machine of a command, with its file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/machine.hpp"
#include "services/documents/edit/kept_settings.hpp"

namespace lockstep {

struct ChosenMachine {
    std::filesystem::path file;
    MachineConfig config;
    std::uint64_t hash = 0;        // of the configuration
    std::filesystem::path source;  // where a person changes it, and beside which senders keep settings; empty: unknown
    KeptSettings settings;         // of senders, which are in `config` already
};

}  // namespace lockstep
