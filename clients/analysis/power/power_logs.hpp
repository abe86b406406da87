// The powers of all analog outputs of a machine with axes X and Y, over the places in their plane.
#pragma once

#include <vector>

#include "clients/analysis/power/power_map.hpp"
#include "clients/analysis/power/power_meter.hpp"
#include "core/kinematics/kinematics.hpp"
#include "services/record/reading/program_events.hpp"
#include "services/record/reading/recorded_program.hpp"

namespace lockstep::analysis {

class PowerLogs {
public:
    /// Begins with the first configuration. Returns whether there is an output to follow, from now on.
    bool begin(const MachineConfig& machine, const Kinematics& kinematics);
    /// Adds what a program asks for.
    void ask(const RecordedProgram& program);
    void take(const channel_event_t& message);
    void at(Tick tick, drawing::Point place_mm);
    /// Moves out the maps of the outputs that were asked for power. `events`: of programs, in order of time.
    std::vector<PowerMap> finish(const std::vector<HappenedEvent>& events);

private:
    struct PowerLog {
        OutputConfig output;
        PowerMeter meter;
        PowerGrid asked;
    };

    std::vector<PowerLog> powers_;
};

}  // namespace lockstep::analysis
