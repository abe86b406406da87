// The machine of a command, with its file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/machine.hpp"

namespace lockstep {

struct ChosenMachine {
    std::filesystem::path file;
    MachineConfig config;
    std::uint64_t hash = 0;  // of the configuration
};

}  // namespace lockstep
