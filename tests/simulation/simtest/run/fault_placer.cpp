#include "tests/simulation/simtest/run/fault_placer.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::simtest {

using Edge = PlannedFault::Edge;

void FaultPlacer::on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& /*node*/) {
    for (const AxisNotice& notice : out.notices) {
        if (notice.kind != AxisNotice::Kind::OwnerAdopted || now < last_) { continue; }
        ++followed_;
        if (followed_ == 1) { reach(Edge::FirstFollows, now); }
        if (followed_ == at_rest_.size()) { reach(Edge::LastFollows, now); }
    }
    if (!out.state) { return; }
    at_rest_[axis] = out.state->at_rest;
    if (std::ranges::find(at_rest_, false) == at_rest_.end()) { reach(Edge::Rest, now); }
}

void FaultPlacer::on_coordinator(std::size_t /*process*/, Tick now, const CoordinatorOutputs& out) {
    for (const JobEvent& job : out.jobs) { take_job_event(job, now); }
    for (const CoordinatorNotice& notice : out.notices) {
        if (notice.kind == CoordinatorNotice::Kind::Claimed) { reach(Edge::Claim, now); }
    }
}

void FaultPlacer::take_job_event(const JobEvent& job, Tick now) {
    if (planned_.empty() || !planned_.front().is_of_frame()) { return; }
    const bool at_begin = job.job_kind == JobKind::Home || planned_.front().at_jog;
    if (job.kind == JobEvent::Kind::Begun && at_begin) { return place(now); }
    if (planned_.front().at_jog) { return; }
    if (job.kind == JobEvent::Kind::EpochBegun && epochs_++ == planned_.front().epoch) {
        place(job.start + slots(frame_slots(planned_.front())));
    }
}

/// A fault that follows another fault comes after the other one has begun.
void FaultPlacer::reach(Edge edge, Tick now) {
    if (!planned_.empty() && planned_.front().edge == edge && now >= last_) { place(now); }
}

void FaultPlacer::place(Tick from) {
    const PlannedFault planned = planned_.front();
    planned_.pop_front();
    VirtualFault fault = planned.fault;
    fault.process = victim_of(planned);
    fault.at = std::max(vm_.now() + Ticks{1}, from + slots(planned.slots));
    last_ = fault.at;
    followed_ = 0;
    const bool crash = fault.kind == VirtualFault::Kind::Crash;
    const bool gone = crash && crashed_until_.contains(fault.process) && crashed_until_[fault.process] >= fault.at;
    const bool itself = fault.peer && *fault.peer == fault.process;
    if (!gone && !itself) { vm_.schedule(fault); }
    if (crash && !gone) { crashed_until_[fault.process] = fault.end(); }
    if (!planned_.empty() && planned_.front().edge == Edge::Before) { place(last_); }
}

/// The edge in slots from the start of the epoch.
double FaultPlacer::frame_slots(const PlannedFault& planned) const {
    const ProtocolTiming& t = vm_.machine().timing;
    const double start = static_cast<double>(planned.frame - 1) * t.frame_slots;
    switch (planned.edge) {
        case Edge::FirstSend: return start - t.send_ahead_slots;
        case Edge::Evidence: return start - t.lease_slots();
        case Edge::Check: return start - t.check_slots();
        case Edge::LastCheck: return start - rules::kLastCheckSlots;
        default: return start;
    }
}

std::size_t FaultPlacer::victim_of(const PlannedFault& planned) const {
    if (planned.victim == PlannedFault::Victim::Process) { return planned.fault.process; }
    const std::size_t first = at_rest_.size();
    const std::size_t owner = vm_.owner().value_or(first);
    if (planned.victim == PlannedFault::Victim::Owner) { return owner; }
    return owner == first ? first + 1 : first;
}

Ticks FaultPlacer::slots(double n) const {
    return {std::llround(n * static_cast<double>(vm_.machine().slot_ticks().value))};
}

}  // namespace lockstep::simtest
