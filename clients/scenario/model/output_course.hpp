// Whether an output of a machine went off, or kept its level, after an act: by the changes that its device noted.
#pragma once

#include <string>
#include <vector>

#include "clients/scenario/model/record_facts.hpp"
#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

struct OutputLevel {
    Tick from;  // machine time
    bool on = false;
    bool operator==(const OutputLevel&) const = default;
};

/// The levels of an output in the order of time. An analog output is on while its value is above 0 or rises.
std::vector<OutputLevel> course_of(const OutputConfig& output, const RecordFacts& facts);

struct FoundOutput {
    bool held = false;
    std::string text;
    Tick at;  // where the record shows it
};

/// `asked` of an output after an act at `act`, in machine time.
FoundOutput output_after(const Asked::OutputAfter& asked, const MachineConfig& machine, const RecordFacts& facts,
                         Tick act);

/// "laser off within 600 ms, not before 500 ms", "clamp keeps its level for 3000 ms"
std::string text_of(const Asked::OutputAfter& asked);

}  // namespace lockstep::scenario
