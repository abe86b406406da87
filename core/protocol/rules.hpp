// The setpoint protocol's rules in one place: lease, arm, veto. Coordinator and axes decide only by these functions.
//
// There is no commit message. The coordinator publishes frames, and each axis decides from the states of all others. In
// every slot every axis publishes which frames it holds and which it vetoes, and the coordinator which it vetoes. A
// state is evidence for frame k if it holds k, vetoes nothing up to k, and is stamped at start(k) - lease or later. The
// coordinator's state counts as holding every frame that it does not veto. An axis arms its device for k as soon as it
// holds k and has evidence from the coordinator and every other axis. At start(k) - V it vetoes k if it has not armed
// it. The device runs k at start(k) if k is armed, k-1 was run, and no veto has arrived since. Otherwise it runs the
// tail of k-1 without further orders. No process has to act to stop the machine.
//
// The rules themselves are in rules.inc. The protocol's model (tests/model) includes the same file, so its exhaustive
// search covers the rules that run here.
//
// Clocks. Each process counts slots, samples and stamps by its own clock. So the two slots of a hop must cover the
// clock errors of sender and receiver, their loop periods, and the network's delay. A check may also be made at the
// very end of its slot. One slot then remains until a process that repeats the veto must have received it:
//
//     kHopSlots * slot >= 2 * loop_period + network_delay + 2 * clock_error
//     slot >= network_delay + 2 * clock_error
//
// With loops of at most half a slot the second inequality is the stricter one. The configuration leaves half a slot for
// the network and refuses a clock_error_limit_us above the quarter that remains. No coordinated move is made with an
// axis if the bound on its clock error (core/clock) exceeds the limit.
//
// Within these bounds, clocks with slot counts that sometimes differ by one are as good as one clock. If both slots are
// used up without the clocks and the counts still differ by one, V has to be 5 + e, because the veto of a late clock,
// or the start by an early one, takes one slot from the two hops.
#pragma once

#include <limits>
#include <optional>

#include "core/protocol/messages.hpp"
#include "core/protocol/rules.inc"
#include "core/protocol/timing.hpp"

namespace lockstep::rules {

/// A message sent in one slot is used in the next slot or the one after it.
inline constexpr Slot kHopSlots = RULE_HOP;
/// A veto must reach every axis over two hops before the frame starts. So no check is made later than this before the
/// start.
inline constexpr Slot kLastCheckSlots = RULE_LAST_CHECK;

constexpr Slot slot_of(Tick tick, Ticks slot) { return tick.value / slot.value; }
constexpr Tick start_of(Slot number, Ticks slot) { return {number * slot.value}; }

enum class CheckTime { Early, Due, TooLate };

/// Early: a frame that starts at `start` may still wait for evidence. TooLate: the axis may neither arm nor veto it.
constexpr CheckTime check_time(Slot now, Slot start, const ProtocolTiming& t) {
    if (RULE_IS_EARLY(now, start, t.check_slots())) { return CheckTime::Early; }
    return RULE_IS_TOO_LATE(now, start) ? CheckTime::TooLate : CheckTime::Due;
}

/// Whether a state with this stamp is evidence for a frame that starts at `start`.
constexpr bool is_evidence(Slot stamp, Slot start, const ProtocolTiming& t) {
    return RULE_IS_EVIDENCE(stamp, start, t.check_slots(), t.freshness_slots);
}

/// Whether an axis may arm frame k.
struct Evidence {
    FrameNumber held = 0;             // by this axis
    std::optional<FrameNumber> veto;  // the lowest known to this axis
    bool all_hold = false;            // evidence from the coordinator and every other axis
};
constexpr bool may_arm(FrameNumber k, const Evidence& e) {
    constexpr FrameNumber kBeyondEveryFrame = std::numeric_limits<FrameNumber>::max();
    return RULE_MAY_ARM(k, e.held, e.veto.value_or(kBeyondEveryFrame), e.all_hold);
}

/// Whether an axis may veto a frame that starts at `start` by the state that it publishes in slot `now`. It may if
/// every axis still receives the veto in time.
constexpr bool axis_may_veto(Slot now, Slot start) { return RULE_AXIS_MAY_VETO(now, start); }
/// Whether a veto of it, by the state that a process publishes in slot `now`, stops every other axis, whatever is lost.
/// It does if no other axis can arm the frame without a state of this process that carries the veto. The coordinator
/// (stop, hold) and an axis that sees a touch veto the first such frame.
constexpr bool veto_is_certain(Slot now, Slot start, const ProtocolTiming& t) {
    return RULE_VETO_IS_CERTAIN(now, start, t.check_slots(), t.freshness_slots);
}

/// The slot in which a frame is first sent, and whether it may still be sent in slot `now`.
constexpr Slot first_send_slot(Slot start, const ProtocolTiming& t) {
    return RULE_FIRST_SEND(start, t.send_ahead_slots);
}
constexpr bool may_send(Slot now, Slot start, const ProtocolTiming& t) {
    return RULE_MAY_SEND(now, start, t.check_slots(), t.freshness_slots);
}

/// Whether an axis changes to the owner of this term, and whether messages of this term may move the axis.
constexpr bool may_follow(const Term& term, const Term& followed, bool hears_owner, bool at_rest) {
    return RULE_MAY_FOLLOW(term, followed, hears_owner, at_rest);
}
constexpr bool is_from_owner(const Term& term, const Term& followed) { return RULE_IS_FROM_OWNER(term, followed); }

/// After how many slots of silence an axis or a coordinator counts as gone while the machine is at rest. No decision
/// about frames in motion depends on this.
constexpr Slot silence_slots(const ProtocolTiming& t) { return 3 * Slot{t.freshness_slots} + 10; }

/// The lower of two vetoes.
constexpr std::optional<FrameNumber> merge(std::optional<FrameNumber> a, std::optional<FrameNumber> b) {
    if (!a) { return b; }
    return b && RULE_VETO_WINS(*b, *a) ? b : a;
}

}  // namespace lockstep::rules
