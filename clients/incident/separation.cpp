#include "clients/incident/separation.hpp"

#include <optional>
#include <utility>

#include "core/protocol/rules.hpp"

namespace lockstep::incident {
namespace {

/// A note of a request is no sign of a fault.
bool is_mark(const FlightEvent& event) {
    return event.kind == FlightKind::Incident && event.detail != static_cast<std::uint8_t>(IncidentReason::Asked);
}

/// The phase of the machine that the event reports; nullopt if it reports none.
std::optional<MachinePhase> phase_in(const Incident& all, const Entry& entry) {
    const bool is_coordinator = all.processes[entry.process].who == kFlightCoordinator;
    const bool is_own = is_coordinator && entry.event.kind == FlightKind::Phase;
    const bool is_received = entry.event.kind == FlightKind::MachinePhaseReceived;
    return is_own || is_received ? std::optional(static_cast<MachinePhase>(entry.event.detail)) : std::nullopt;
}

bool is_in_order(MachinePhase phase) {
    return phase == MachinePhase::Idle || phase == MachinePhase::Homing || phase == MachinePhase::Running ||
           phase == MachinePhase::Jogging;
}

bool begins_motion(const FlightEvent& event) {
    return event.kind == FlightKind::EpochBegun || event.kind == FlightKind::JobBegun;
}

class Separation {
public:
    explicit Separation(const Incident& all)
        : all_(all),
          together_(all.slots(2 * rules::silence_slots(all.machine.timing))),
          hop_(all.slots(rules::kHopSlots)),
          was_in_fault_(all.processes.size(), false) {}

    std::vector<Tick> boundaries() && {
        for (const Entry& entry : all_.timeline) { take(entry); }
        return std::move(found_);
    }

private:
    void take(const Entry& entry) {
        if (is_mark(entry.event)) { return take_mark(entry.tick); }
        if (begins_motion(entry.event)) { return note(continued_, entry.tick); }
        const auto phase = phase_in(all_, entry);
        if (!phase) { return; }
        if (*phase == MachinePhase::Fault) { was_in_fault_[entry.process] = true; }
        if (!is_in_order(*phase)) { return; }
        note(continued_, entry.tick);
        if (was_in_fault_[entry.process]) { note(recovered_, entry.tick); }
        was_in_fault_[entry.process] = false;
    }

    /// Keeps the first sign since the last mark. A sign within a hop of the mark may have been decided before the mark.
    void note(std::optional<Tick>& sign, Tick tick) const {
        if (mark_ && !sign && tick - *mark_ > hop_) { sign = tick; }
    }

    void take_mark(Tick tick) {
        const bool is_later = mark_ && tick - *mark_ > together_;
        if (recovered_) {
            found_.push_back(*recovered_);
        } else if (continued_ && is_later) {
            found_.push_back(*continued_);
        }
        mark_ = tick;
        continued_.reset();
        recovered_.reset();
    }

    const Incident& all_;
    Ticks together_;                  // twice the time after which a process that ended counts as gone
    Ticks hop_;                       // a message arrives within this time
    std::vector<bool> was_in_fault_;  // of each process: the last phase of the machine that it noted
    std::optional<Tick> mark_;        // the last one
    std::optional<Tick> continued_;   // since then
    std::optional<Tick> recovered_;   // from Fault, since then
    std::vector<Tick> found_;
};

}  // namespace

std::vector<Tick> boundaries(const Incident& all) { return Separation(all).boundaries(); }

}  // namespace lockstep::incident
