#include "core/flight/peer_watch.hpp"

#include <utility>

#include "core/protocol/rules.hpp"

namespace lockstep {

SilenceLimits silence_limits(const MachineConfig& machine) {
    const Ticks slot = machine.slot_ticks();
    return {slot * machine.timing.freshness_slots, slot * rules::silence_slots(machine.timing)};
}

void PeerWatch::receive(Tick now, const News& news, FlightLog& log) {
    const Ticks silence = last_ ? now - received_ : Ticks{};
    if (!last_ || silence > limits_.noted) {
        log.add({.tick = now, .kind = FlightKind::PeerReceived, .about = peer_, .lasts = silence});
    }
    received_ = now;
    is_silent_ = is_lost_ = false;
    if (last_) { receive_identity(now, news.identity, log); }
    const bool is_new_veto = news.veto && !(last_ && last_->epoch == news.epoch && last_->veto == news.veto);
    if (is_new_veto) {
        log.add({.tick = now, .kind = FlightKind::PeerVeto, .about = peer_, .epoch = news.epoch, .frame = *news.veto});
    }
    const FaultCode before = last_ ? last_->fault : FaultCode::None;
    last_ = news;
    if (news.fault == before || news.fault == FaultCode::None) { return; }
    log.add({.tick = now, .kind = FlightKind::PeerFault, .about = peer_, .fault = news.fault});
    log.incident(now, IncidentReason::Fault, peer_);
}

/// A changed identity of the owner is no incident here, because the axis's controller reports a new owner itself.
void PeerWatch::receive_identity(Tick now, Identity identity, FlightLog& log) {
    if (last_->identity == identity) { return; }
    log.add({.tick = now, .kind = FlightKind::PeerRestarted, .about = peer_});
    if (peer_.kind == FlightPeer::Kind::Axis) { log.incident(now, IncidentReason::AxisLost, peer_); }
}

void PeerWatch::look(Tick now, Ticks missed, FlightLog& log) {
    received_ = std::min(now, received_ + missed);
    if (!last_ || is_lost_) { return; }
    const Ticks silence = now - received_;
    if (silence > limits_.noted && !std::exchange(is_silent_, silence > limits_.noted)) {
        log.add({.tick = now, .kind = FlightKind::PeerSilent, .about = peer_, .lasts = silence});
    }
    is_lost_ = silence > limits_.lost;
    if (is_lost_) { log.incident(now, lost(), peer_); }
}

}  // namespace lockstep
