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

private:
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
};

}  // namespace

/// If a process ended, the later motion of its device is not known. The next life of the process does not show it.
std::optional<Tick> all_at_rest(const Incident& incident, Tick since) {
    std::optional<Tick> all;
    for (std::size_t process = 0; process < incident.processes.size(); ++process) {
        if (incident.processes[process].who.kind != FlightPeer::Kind::Axis) { continue; }
        RestWatch watch(since);
        for (const Entry& entry : incident.timeline) {
            if (entry.process == process) { watch.take(entry.event); }
        }
        if (watch.rest()) { all = std::max(all.value_or(*watch.rest()), *watch.rest()); }
    }
    return all;
}

}  // namespace lockstep::incident
