#include "clients/session/measuring/measuring_stream.hpp"

#include "services/documents/program_file.hpp"

namespace lockstep {

std::string title_of(MeasureKind kind) { return "probe " + std::string(name_of(kind)); }

ProgramStream measuring_stream(const MachineSetup& machine, const std::vector<double>& start_mm, MeasureKind kind,
                               const MeasuringProgram& program, std::uint64_t revision) {
    GcodeSetup setup = gcode_setup(machine, start_mm, title_of(kind));
    setup.find_subroutine = subroutines_of(machine);
    return {LineReader::of_text(program.text), setup, revision};
}

}  // namespace lockstep
