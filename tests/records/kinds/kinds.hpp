// The kinds of valid records: how each is made, and what the tools must say about it.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/records/expected.hpp"
#include "tests/records/machine_run.hpp"
#include "tests/records/record.hpp"

namespace lockstep::records {

struct RecordKind {
    std::string name;  // letters, digits and _
    std::function<Record()> make;
    Expected expected = kValid;

    /// For GoogleTest.
    friend void PrintTo(const RecordKind& kind, std::ostream* out) { *out << kind.name; }
};

std::vector<RecordKind> path_kinds();          // lines, arcs, helices, splines, cycles
std::vector<RecordKind> file_kinds();          // the programs of deploy/examples
std::vector<RecordKind> interruption_kinds();  // holds, overrides, pauses, stops, events
std::vector<RecordKind> own_move_kinds();      // own moves by each method, jogs, homing
std::vector<RecordKind> process_kinds();       // restarts and takeovers
std::vector<RecordKind> machine_kinds();       // clocks, networks and other machines
std::vector<RecordKind> file_of_log_kinds();   // merged, extracted, begun late, cut
/// All of them.
const std::vector<RecordKind>& record_kinds();

/// A record of homing and one program on the small mill.
Record recorded_program(const std::string& gcode);
Record recorded_program(const MachineSetup& machine, const std::string& gcode);

}  // namespace lockstep::records
