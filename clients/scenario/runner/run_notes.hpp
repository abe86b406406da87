// What is observed while a scenario runs, with the time since its begin.
#pragma once

#include <string>

#include "clients/scenario/model/facts.hpp"
#include "core/machine.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::scenario {

class RunNotes {
public:
    explicit RunNotes(const MachineConfig& machine)
        : machine_(machine), clock_(machine.tick_ns, machine.timing.time_source), begin_(clock_.now()) {}

    /// Times count from now on.
    void begin() { begin_ = clock_.now(); }
    Tick now() const { return clock_.now(); }
    double seconds_at(Tick tick) const { return machine_.microseconds(tick - begin_) * 1e-6; }

    void note(const std::string& what) { note(what, now()); }
    void note(const std::string& what, Tick at) {
        proto::ScenarioHappening& happening = observed_.events.emplace_back();
        happening.set_tick(at.value);
        happening.set_at_s(seconds_at(at));
        happening.set_what(what);
    }
    void add_check(const std::string& asked, const std::string& found, bool held) {
        observed_.checks.push_back(check_of(asked, found, kAsObserved, held));
    }

    Observations& observed() { return observed_; }
    const Observations& observed() const { return observed_; }

private:
    const MachineConfig& machine_;
    MachineClock clock_;
    Tick begin_;
    Observations observed_;
};

}  // namespace lockstep::scenario
