#include <algorithm>

#include "tests/simulation/simtest/check/checks.hpp"

namespace lockstep::simtest {
namespace {

/// Whether a fault began or lasted until then.
bool is_disturbed(const Recording& recording, const JobRecord& job, Tick until) {
    return recording.lossy() || std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
               return fault.at <= until && fault.end() >= job.began;
           });
}

void check_jog(const Recording& recording, const JogRecord& jog, Violations& violations) {
    const JobRecord& job = recording.jobs[jog.job];
    if (is_disturbed(recording, job, jog.ends)) { return; }
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        const auto steps = recording.steps_of(job, i);
        if (steps.empty()) { continue; }
        const Tick last = recording.motors[i].truth(steps.back());
        if (last <= jog.ends) { continue; }
        violations.push_back({"jog",
                              i,
                              last.value,
                              {},
                              "a pulse " + std::to_string((last - jog.released).value) + " ticks after " +
                                  (jog.by_silence ? "the last renewal" : "the release") + ", at most " +
                                  std::to_string((jog.ends - jog.released).value)});
    }
}

}  // namespace

Violations check_jogs(const Recording& recording) {
    Violations violations;
    for (const JogRecord& jog : recording.jogs) { check_jog(recording, jog, violations); }
    return violations;
}

}  // namespace lockstep::simtest
