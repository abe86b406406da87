// When the scripted events of a job are due, decided from the states that the machine publishes. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/scenario/model/scenario.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::scenario {

/// The state of the machine at one time.
struct Moment {
    double since_begun_s = 0;  // of the job
    MachinePhase phase = MachinePhase::Waiting;
    std::int32_t line = 0;                     // of the G-code in motion
    std::vector<std::optional<double>> at_mm;  // of each axis; nothing: no state received
};

class EventSchedule {
public:
    /// `axes`: the names of those in Moment::at_mm. `step` outlives this.
    EventSchedule(const Asked::Step& step, std::vector<std::string> axes) : step_(step), axes_(std::move(axes)) {}

    /// The next event that is due now; null: none is due yet. Call it until it returns null.
    const Asked::During* next(const Moment& now);

    /// How many events have been due.
    int done() const { return done_; }

private:
    bool has_happened(const Asked::During& during, const Moment& now) const;
    bool passes(const Asked::Target& place, const Moment& now) const;

    const Asked::Step& step_;
    std::vector<std::string> axes_;
    int done_ = 0;
    std::optional<double> event_at_s_;  // of the next event; since the job's beginning
    std::optional<Moment> before_;
};

/// Whether the machine is in the requested phase.
bool is_in(Asked::Phase asked, MachinePhase phase);

}  // namespace lockstep::scenario
