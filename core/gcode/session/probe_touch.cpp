#include "core/gcode/session/probe_touch.hpp"

#include <utility>

namespace lockstep {

std::string ForeignProbeResult::text() const {
    return "the coordinator's result of the probing move of job " + std::to_string(job) + " has places of " +
           std::to_string(places) + " axes, but the machine has " + std::to_string(axes) +
           "; start the coordinator and this program with the same machine's file";
}

std::expected<ProbeTouch, ForeignProbeResult> touch_from(const ProbeResult& result, std::vector<double> rest_mm) {
    if (result.places_mm.size() != rest_mm.size()) {
        return std::unexpected(ForeignProbeResult{result.job, result.places_mm.size(), rest_mm.size()});
    }
    return ProbeTouch{.touched = result.touched(),
                      .places_mm = {result.places_mm.begin(), result.places_mm.end()},
                      .rest_mm = std::move(rest_mm),
                      .input = result.input};
}

}  // namespace lockstep
