#include "clients/incident/rest.hpp"

#include <algorithm>

namespace lockstep::incident {
namespace {

bool is_moving(const FlightEvent& state) {
    const auto phase = static_cast<AxisPhase>(state.detail);
    return state.amount != 0 || phase == AxisPhase::Accelerate || phase == AxisPhase::Cruise ||
           phase == AxisPhase::Decelerate;
}

/// Finds when one axis came to rest. In an epoch this is the end of the tail that it ran, or the end of the epoch.
/// Outside an epoch its states show it.
class RestWatch {
public:
    explicit RestWatch(Tick since) : since_(since) {}

    void take(const FlightEvent& event) {
        const bool is_state = event.kind == FlightKind::State || event.kind == FlightKind::Phase;
        if (is_state) { take_place(event); }
        if (rest_) { return; }
        switch (event.kind) {
            case FlightKind::EpochBegun:
                if (event.tick <= since_) { in_epoch_ = true; }
                break;
            case FlightKind::TailRun:
                if (event.tick + event.lasts > since_) { rest_ = event.tick + event.lasts; }
                break;
            case FlightKind::EpochEnded: end_epoch(event.tick); break;
            case FlightKind::State:
            case FlightKind::Phase: take_state(event); break;
            default: break;
        }
    }
    std::optional<Tick> rest() const { return rest_; }
    /// An axis is in an epoch also while only others move. So its speed counts, or that its position changed until it
    /// was at rest.
    bool was_moving() const { return speed_ != 0 || has_changed_; }

private:
    void take_place(const FlightEvent& state) {
        if (state.tick <= since_) {
            place_ = state.count;
            speed_ = state.amount;
            has_place_ = true;
        } else if (has_place_ && rest_) {
            has_changed_ |= state.count != place_;
            has_place_ = false;
        }
    }
    void end_epoch(Tick tick) {
        if (in_epoch_ && tick > since_) { rest_ = tick; }
        in_epoch_ = false;
    }
    void take_state(const FlightEvent& state) {
        if (state.tick <= since_) {
            moved_ = is_moving(state);
        } else if (moved_ && !in_epoch_ && !is_moving(state)) {
            rest_ = state.tick;
        }
    }

    Tick since_;
    bool in_epoch_ = false;
    bool moved_ = false;
    std::optional<Tick> rest_;
    std::int64_t place_ = 0;    // steps: at the last state until `since`
    double speed_ = 0;          // steps/s: then
    bool has_place_ = false;    // until it was compared with the first state after the rest
    bool has_changed_ = false;  // the place, until then
};

}  // namespace

/// If a process ended, the later motion of its device is not known. The next life of the process does not show it.
Rest rest_of(const Incident& incident, Tick since) {
    Rest rest;
    for (std::size_t process = 0; process < incident.processes.size(); ++process) {
        const FlightPeer who = incident.processes[process].who;
        if (who.kind != FlightPeer::Kind::Axis) { continue; }
        RestWatch watch(since);
        for (const Entry& entry : incident.timeline) {
            if (entry.process == process) { watch.take(entry.event); }
        }
        const auto at = watch.rest();
        if (at) { rest.at = std::max(rest.at.value_or(*at), *at); }
        if (watch.was_moving()) { rest.moving.insert(who.motor()); }
        if (watch.was_moving() && !at) { rest.without_rest.insert(who.motor()); }
    }
    return rest;
}

}  // namespace lockstep::incident
