// The setpoint protocol's rules in one table: lease, arm, veto. Both sides decide by these functions alone.
//
// There is no commit message. The coordinator publishes frames, and each axis decides from the states of all others.
// In every slot every axis publishes which frames it holds and which it vetoes, and the coordinator which it vetoes. A
// state is evidence for frame k if it holds k, vetoes nothing up to k, and is stamped at start(k) - lease or later; the
// coordinator's state holds every frame that it does not veto. An axis arms its device for k as soon as it holds k and
// has evidence from the coordinator and every other axis. At start(k) - V it vetoes k if it has not armed it. The
// device runs k at start(k) if k is armed, k-1 was run, and no veto came since; otherwise it runs the tail of k-1 by
// itself. No process has to act for the machine to stop.
//
// The rules themselves stand in rules.inc, which the protocol's model (tests/model) reads too: what is searched
// exhaustively there is what runs here.
//
// Clocks. Each process counts slots, samples and stamps by its own clock, so a hop's two slots hold its error, too, at
// both ends, beside the network's delay and the loop periods of who speaks and who listens. And a check may be made at
// the very end of its slot, which leaves one slot until whoever repeats its veto must have heard it:
//
//     kHopSlots * slot >= 2 * loop_period + network_delay + 2 * clock_error
//     slot >= network_delay + 2 * clock_error
//
// With loops of at most half a slot the second is the narrower one. The configuration leaves the network half a slot,
// and refuses a clock_error_limit_us above what then remains, a quarter; no coordinated move is made with an axis whose
// clock may be further off than the limit (core/clock says how far that is).
//
// Then clocks whose counts differ by a slot at times are as good as one. Where the two slots are used up without the
// clocks and counts still differ by one, V has to be 5 + s: a late clock's veto, or an early one's start, takes a slot
// from the two hops.
#pragma once

#include <limits>
#include <optional>

#include "core/protocol/messages.hpp"
#include "core/protocol/rules.inc"
#include "core/protocol/timing.hpp"

namespace lockstep::rules {

/// A message sent in one slot is used in the next or the one after.
inline constexpr Slot kHopSlots = RULE_HOP;
/// A veto must reach an axis over two hops before the frame starts: no check is made later than this before the start.
inline constexpr Slot kLastCheckSlots = RULE_LAST_CHECK;

constexpr Slot slot_of(Tick tick, Ticks slot) { return tick.value / slot.value; }
constexpr Tick start_of(Slot number, Ticks slot) { return {number * slot.value}; }

/// The slot in which an axis vetoes a frame that it has not armed, from the frame's start.
constexpr Slot check_slot(Slot start, const ProtocolTiming& t) { return RULE_CHECK_SLOT(start, t.check_slots()); }

enum class CheckTime { Early, Due, TooLate };

/// Early: a frame that starts at `start` may still wait for evidence. TooLate: it may neither be armed nor vetoed.
constexpr CheckTime check_time(Slot now, Slot start, const ProtocolTiming& t) {
    if (RULE_IS_EARLY(now, start, t.check_slots())) { return CheckTime::Early; }
    return RULE_IS_TOO_LATE(now, start) ? CheckTime::TooLate : CheckTime::Due;
}

/// The first stamp with which a state is evidence for a frame that starts at `start`.
constexpr Slot first_evidence_slot(Slot start, const ProtocolTiming& t) {
    return RULE_FIRST_EVIDENCE(start, t.check_slots(), t.freshness_slots);
}
constexpr bool is_evidence(Slot stamp, Slot start, const ProtocolTiming& t) {
    return RULE_IS_EVIDENCE(stamp, start, t.check_slots(), t.freshness_slots);
}

/// Whether an axis may arm frame k.
struct Evidence {
    FrameNumber held = 0;             // by this axis
    std::optional<FrameNumber> veto;  // the lowest known
    bool all_hold = false;            // evidence from the coordinator and every other axis
};
constexpr bool may_arm(FrameNumber k, const Evidence& e) {
    constexpr FrameNumber kBeyondEveryFrame = std::numeric_limits<FrameNumber>::max();
    return RULE_MAY_ARM(k, e.held, e.veto.value_or(kBeyondEveryFrame), e.all_hold);
}

/// Whether an axis may veto a frame that starts at `start` by the state it publishes in slot `now`: every axis still
/// receives it in time.
constexpr bool axis_may_veto(Slot now, Slot start) { return RULE_AXIS_MAY_VETO(now, start); }
/// Whether the coordinator may veto it by the state it publishes in slot `now` (a stop, a hold): no axis can have armed
/// it.
constexpr bool coordinator_may_veto(Slot now, Slot start, const ProtocolTiming& t) {
    return RULE_COORDINATOR_MAY_VETO(now, start, t.check_slots(), t.freshness_slots);
}

/// When a frame is first sent, and the last slot in which it is sent at all.
constexpr Slot first_send_slot(Slot start, const ProtocolTiming& t) {
    return RULE_FIRST_SEND(start, t.send_ahead_slots);
}
constexpr bool may_send(Slot now, Slot start, const ProtocolTiming& t) {
    return RULE_MAY_SEND(now, start, t.check_slots(), t.freshness_slots);
}

/// Whether an axis changes to the owner of this term, and whether what is said in it moves the axis.
constexpr bool may_follow(const Term& term, const Term& followed, bool hears_owner, bool at_rest) {
    return RULE_MAY_FOLLOW(term, followed, hears_owner, at_rest);
}
constexpr bool is_from_owner(const Term& term, const Term& followed) { return RULE_IS_FROM_OWNER(term, followed); }

/// How long an axis or a coordinator may be unheard before it counts as gone for a machine at rest. A machine in
/// motion never judges by this.
constexpr Slot silence_slots(const ProtocolTiming& t) { return 3 * Slot{t.freshness_slots} + 10; }

/// The lowest of two vetoes.
constexpr std::optional<FrameNumber> merge(std::optional<FrameNumber> a, std::optional<FrameNumber> b) {
    if (!a) { return b; }
    return b && RULE_VETO_WINS(*b, *a) ? b : a;
}

}  // namespace lockstep::rules
