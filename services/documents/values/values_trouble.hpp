// What is wrong with the coordinator's file of offsets and tools, or with their place on its disk, as text for a
// person.
#pragma once

#include <optional>
#include <string>

namespace lockstep {

/// Why a coordinator of the machine cannot start on this host, with the remedy: its file cannot be read or is damaged.
/// nullopt: it can, or it has no file.
std::optional<std::string> values_file_trouble(const std::string& machine);

/// The effect of values that are not on the disk, and the remedy.
inline constexpr const char* kUnsavedValues =
    "offsets and tools changed, but are not on the coordinator's disk: they are lost when it ends";
inline constexpr const char* kUnsavedValuesRemedy =
    "make room on the disk, or correct the directory's permissions; the coordinator's log names the file, and it tries "
    "again every 5 s";

}  // namespace lockstep
