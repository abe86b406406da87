// Programs that each have one kind of path, and jobs from files.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "core/program.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep::planners {

struct NamedProgram {
    std::string name;
    Program program;
    double klipper_chord_mm = 1;  // for arcs
};

/// Lines, circles and corners, generated here.
std::vector<NamedProgram> simple_paths();

/// The job set, from the folder that make-jobs wrote. A job with arcs is listed twice: with chords of Klipper's default
/// length and with finer ones. Error: the first problem of a file.
std::expected<std::vector<NamedProgram>, std::string> jobs_of(const std::filesystem::path& folder,
                                                              const MachineSetup& machine);

}  // namespace lockstep::planners
