// Programs of one kind of path each, and jobs from their files.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::planners {

struct NamedProgram {
    std::string name;
    Program program;
    double klipper_chord_mm = 1;  // of arcs
};

/// Lines, circles and corners, made here.
std::vector<NamedProgram> simple_paths();

/// The job set, from the folder that make-jobs wrote. Jobs with arcs stand there twice: with chords of Klipper's
/// default and with finer ones. Error: what is wrong with a file.
std::expected<std::vector<NamedProgram>, std::string> jobs_of(const std::filesystem::path& folder,
                                                              const MachineConfig& machine);

}  // namespace lockstep::planners
