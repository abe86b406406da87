#include "tests/simulation/simtest/draw/draw_takeover.hpp"

#include "core/protocol/rules.hpp"

namespace lockstep::simtest {
namespace {

using FaultEdge = PlannedFault::Edge;
using Victim = PlannedFault::Victim;

class TakeoverDraw {
public:
    TakeoverDraw(Draw& draw, const MachineConfig& machine)
        : draw_(draw), machine_(machine), silence_(static_cast<double>(rules::silence_slots(machine.timing))) {}

    /// The first fault usually affects the owner. Up to three more affect the takeover that follows.
    std::vector<PlannedFault> faults() {
        std::vector<PlannedFault> planned;
        add(planned, draw_.chance(0.75) ? Victim::Owner : Victim::Other);
        for (int more = 0; more < 3 && draw_.chance(0.6); ++more) {
            add(planned, draw_victim());
            place_after_the_one_before(planned.back());
        }
        spread_cuts(planned);
        return planned;
    }

private:
    std::size_t motors() const { return motor_count(machine_); }

    Victim draw_victim() {
        const double part = draw_.part();
        return part < 0.4 ? Victim::Owner : (part < 0.75 ? Victim::Other : Victim::Process);
    }

    /// About the tolerated stall, about the time after which a lost process is given up, or several times that.
    Ticks draw_length() {
        const ProtocolTiming& t = machine_.timing;
        const double slots = [&] {
            switch (draw_.index(4)) {
                case 0: return draw_.real(0.5, 2.0 * t.stall_slots + 2);
                case 1: return silence_ + draw_.real(-4, 8);
                case 2: return silence_ + draw_.real(0, t.send_ahead_slots + 2.0 * t.frame_slots);
                default: return draw_.real(0.5, 4) * silence_;
            }
        }();
        return {static_cast<std::int64_t>(slots * static_cast<double>(machine_.slot_ticks().value))};
    }

    void add(std::vector<PlannedFault>& planned, Victim victim) {
        PlannedFault one{.victim = victim};
        one.fault.process = draw_.index(motors());  // used if an axis is the victim
        one.fault.kind = draw_.any_of({FaultKind::Freeze, FaultKind::Freeze, FaultKind::Crash, FaultKind::Cut});
        one.fault.in_loop = one.fault.kind == FaultKind::Freeze && draw_.chance(0.5);
        one.fault.lasts = draw_length();
        if (one.fault.kind == FaultKind::Cut) { draw_ways(one.fault); }
        planned.push_back(one);
    }

    void draw_ways(VirtualFault& fault) {
        const std::size_t way = draw_.index(4);
        fault.outgoing = way != 1;
        fault.incoming = way != 2;
    }

    void place_after_the_one_before(PlannedFault& planned) {
        planned.edge = draw_.any_of(
            {FaultEdge::Before, FaultEdge::Claim, FaultEdge::FirstFollows, FaultEdge::LastFollows, FaultEdge::Rest});
        planned.slots = draw_.chance(0.7) ? draw_.real(0, 4) : draw_.real(0, silence_);
        if (planned.edge == FaultEdge::Before && draw_.chance(0.7)) { planned.slots = silence_ + draw_.real(-4, 8); }
    }

    /// A cut separates its victim from all others, or the two coordinators, or the victim and some axes.
    void spread_cuts(std::vector<PlannedFault>& planned) {
        for (std::size_t n = 0; n < planned.size(); ++n) {
            if (planned[n].fault.kind != FaultKind::Cut || draw_.chance(0.4)) { continue; }
            const std::vector<std::size_t> peers = draw_peers();
            planned[n].fault.peer = peers.front();
            for (std::size_t i = 1; i < peers.size(); ++i) {
                PlannedFault same = planned[n];
                same.fault.peer = peers[i];
                same.edge = FaultEdge::Before;
                same.slots = 0;
                planned.insert(planned.begin() + static_cast<std::ptrdiff_t>(++n), same);
            }
        }
    }

    /// The numbers of both coordinators stand for the other coordinator: no cut from itself is placed.
    std::vector<std::size_t> draw_peers() {
        std::vector<std::size_t> peers;
        for (std::size_t i = 0; i < motors(); ++i) {
            if (draw_.chance(0.5)) { peers.push_back(i); }
        }
        if (peers.empty() || draw_.chance(0.5)) { peers.insert(peers.end(), {motors(), motors() + 1}); }
        return peers;
    }

    Draw& draw_;
    const MachineConfig& machine_;
    double silence_;
};

}  // namespace

std::vector<PlannedFault> draw_takeover(Draw& draw, const MachineConfig& machine) {
    std::vector<PlannedFault> planned = TakeoverDraw(draw, machine).faults();
    PlannedFault& first = planned.front();
    first.epoch = draw.chance(0.8) ? 0 : 1;
    first.frame = draw.chance(0.5) ? 1 + draw.index(3) : 1 + static_cast<FrameNumber>(draw.magnitude(1, 60));
    first.edge = static_cast<FaultEdge>(draw.index(PlannedFault::kFrameEdges));
    first.slots = draw.chance(0.7) ? draw.real(-2, 2) : draw.real(0, machine.timing.frame_slots);
    return planned;
}

std::vector<PlannedFault> draw_takeover_of_homing(Draw& draw, const MachineConfig& machine) {
    std::vector<PlannedFault> planned = TakeoverDraw(draw, machine).faults();
    planned.front().slots = draw.magnitude(0.001, 2) * 1e6 / static_cast<double>(machine.timing.slot_us);
    return planned;
}

void draw_late_network(Draw& draw, const MachineConfig& machine, std::vector<PlannedFault>& planned) {
    if (planned.empty() || planned.front().fault.kind != FaultKind::Freeze || !draw.chance(0.3)) { return; }
    const auto slots = static_cast<double>(rules::silence_slots(machine.timing)) + draw.real(-4, 4);
    const Ticks behind{static_cast<std::int64_t>(slots * static_cast<double>(machine.slot_ticks().value))};
    PlannedFault cut = planned.front();
    cut.edge = FaultEdge::Before;
    cut.slots = 0;
    cut.fault.kind = FaultKind::Cut;
    cut.fault.in_loop = false;
    cut.fault.lasts += behind;
    planned.insert(planned.begin() + 1, cut);
}

}  // namespace lockstep::simtest
