// Reads the program of a measurement, part by part, as its touches become known.
#pragma once

#include <string>

#include "clients/session/measuring/measuring_program.hpp"
#include "clients/session/program_stream.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// "probe bore": of programs, jobs and reports.
std::string title_of(MeasureKind kind);

/// Machine coordinates: without the machine's offsets and tools. `revision`: of the machine's values now.
ProgramStream measuring_stream(const MachineSetup& machine, const std::vector<double>& start_mm, MeasureKind kind,
                               const MeasuringProgram& program, std::uint64_t revision);

}  // namespace lockstep
