// The newest measurement of this server, while it runs and afterwards.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "clients/web/machine/probing_run.hpp"
#include "clients/web/measuring/measurement.hpp"

namespace lockstep::web {

class Measuring {
public:
    /// Its program has begun to run.
    void begin(std::shared_ptr<const MeasurePlan> plan);
    /// A part of a program has begun to run. `measures`: what it measures. It ends a measurement that still runs,
    /// unless it is the next part of that.
    void note_begin(const MeasurePlan* measures);
    /// A part of its program is over, or the whole program.
    void note(const ProbingRun& run, const MachineSetup& machine);
    /// The machine refuses the next part.
    void fail(const Problem& problem);

    const std::optional<Measurement>& newest() const { return newest_; }

private:
    std::optional<Measurement> newest_;
    std::vector<ProbeTouch> touches_;
};

}  // namespace lockstep::web
