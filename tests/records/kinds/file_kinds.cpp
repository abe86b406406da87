// Records of the programs in deploy/examples.
#include <filesystem>
#include <stdexcept>

#include "clients/planning/plan_summary.hpp"
#include "clients/simulation/simulate.hpp"
#include "services/documents/program_file.hpp"
#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {
namespace {

Record recorded_file(const std::string& name, const std::string& machine_name) {
    const MachineSetup machine = example_machine(machine_name);
    const auto file = read_program_file("deploy/examples/" + name + ".gcode", machine, parked_mm(machine));
    if (!file) { throw std::runtime_error(name + " is refused"); }
    MemorySink sink;
    const auto result = simulate(machine, file->reading.program, sink);
    if (!result || result->outcome != JobOutcome::Done) { throw std::runtime_error(name + " is not run to its end"); }
    return std::move(sink.record);
}

}  // namespace

std::vector<RecordKind> file_kinds() {
    std::vector<RecordKind> kinds;
    for (const std::string name : {"contour", "drilling", "plate", "pocket"}) {
        kinds.push_back({"example_" + name, [name] { return recorded_file(name, "three-axis"); }});
    }
    for (const std::string name : {"contour", "plate"}) {
        kinds.push_back({"example_" + name + "_on_the_gantry", [name] { return recorded_file(name, "gantry"); }});
        kinds.push_back({"example_" + name + "_on_two_belts", [name] { return recorded_file(name, "core-xy"); }});
    }
    return kinds;
}

}  // namespace lockstep::records
