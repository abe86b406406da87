// The directory of the lockstep command: its services are beside it, shared files in ../share/lockstep.
#pragma once

#include <filesystem>

namespace lockstep {

inline std::filesystem::path program_folder() {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

}  // namespace lockstep
