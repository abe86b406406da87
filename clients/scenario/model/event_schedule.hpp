// Decides when the scripted events of a job are due, from the states that the machine publishes. Does no I/O.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/scenario/model/scenario.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::scenario {

/// The state of the machine at one time.
struct Moment {
    double since_begun_s = 0;  // since the job began
    MachinePhase phase = MachinePhase::Waiting;
    std::optional<std::int32_t> line;          // of the G-code in motion
    std::vector<std::optional<double>> at_mm;  // of each axis; nullopt if no state was received
};

class EventSchedule {
public:
    /// `axes`: names of the axes in Moment::at_mm, in the same order. `step` must outlive this object.
    EventSchedule(const Asked::Step& step, std::vector<std::string> axes) : step_(step), axes_(std::move(axes)) {}

    /// Returns the next event that is due now, or null if none is. Call it until it returns null.
    const Asked::During* next(const Moment& now);

    /// The number of events that have been due.
    int done() const { return done_; }

private:
    bool has_happened(const Asked::During& during, const Moment& now) const;
    bool passes(const Asked::Target& place, const Moment& now) const;

    const Asked::Step& step_;
    std::vector<std::string> axes_;
    int done_ = 0;
    std::optional<double> event_at_s_;  // when the next event's condition became true, since the job's beginning
    std::optional<Moment> before_;
};

/// Whether the machine is in the requested phase.
bool is_in(Asked::Phase asked, MachinePhase phase);

}  // namespace lockstep::scenario
