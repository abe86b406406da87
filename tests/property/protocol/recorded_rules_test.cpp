// The rules of the protocol, at every slot around each of their limits, and what the parts that apply them answer to
// messages in any order, stay as recorded. To write the files: LOCKSTEP_WRITE_HASHES=1 build/bin/property_protocol

#include "core/axis/following/owner_link.hpp"
#include "core/protocol/frame_room.hpp"
#include "core/protocol/peer_evidence.hpp"
#include "core/protocol/reception_watch.hpp"
#include "core/protocol/rival.hpp"
#include "core/protocol/second_process.hpp"
#include "core/protocol/slot_gate.hpp"
#include "tests/property/draw_below.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/property/recorded_text.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kTimings = 150;
constexpr std::uint32_t kSequences = 400;

ProtocolTiming timing_of(std::uint32_t number) {
    Random random(number);
    ProtocolTiming t{.slot_us = 100 * (1 + draw_below(random, 200))};
    t.stall_slots = static_cast<int>(draw_below(random, 30));
    t.late_check_slots = static_cast<int>(draw_below(random, t.stall_slots + 1));
    t.freshness_slots = t.stall_slots + 1 + static_cast<int>(draw_below(random, 3));
    t.send_ahead_slots = t.send_deadline_slots() + t.stall_slots + 1 + static_cast<int>(draw_below(random, 20));
    t.frame_slots = 1 + static_cast<int>(draw_below(random, 12));
    return t;
}

std::string rules_of(std::uint32_t number) {
    constexpr Slot kStart = 1000;
    const ProtocolTiming t = timing_of(number);
    const ProtocolTiming least = with_least_times(t);
    const OutputRoom room = output_room(t);
    RecordedText text;
    text.line(t.check_slots(), t.lease_slots(), t.send_deadline_slots(), t.most_clock_error_us(), frames_ahead(t),
              body_pieces(t), room.body, room.tail, rules::silence_slots(t), rules::first_send_slot(kStart, t));
    text.line(least.freshness_slots, least.send_ahead_slots, least.frame_slots);
    for (Slot now = kStart - 3 * Slot{t.send_ahead_slots}; now <= kStart + 2; ++now) {
        text.line(rules::check_time(now, kStart, t), rules::is_evidence(now, kStart, t),
                  rules::axis_may_veto(now, kStart), rules::veto_is_certain(now, kStart, t),
                  rules::may_send(now, kStart, t));
    }
    return text.text();
}

/// All cases of the rules without times.
std::string decisions(std::uint32_t k) {
    RecordedText text;
    for (FrameNumber held = 0; held < 5; ++held) {
        for (FrameNumber veto = 0; veto < 6; ++veto) {
            const auto known = veto == 5 ? std::nullopt : std::optional(veto);
            const auto other = held == 4 ? std::nullopt : std::optional(held);
            text.line(rules::may_arm(k, {held, known, true}), rules::may_arm(k, {held, known, false}),
                      rules::merge(known, other), RULE_DEVICE_RUNS(k, held, veto, FrameNumber{4}),
                      RULE_DEVICE_RUNS(k, held, FrameNumber{4}, veto));
        }
    }
    const Term followed{k, 2};
    for (const Term& term : {Term{k, 1}, Term{k, 2}, Term{k, 3}, Term{k + 1, 1}, Term{}}) {
        for (const bool hears : {false, true}) {
            text.line(rules::may_follow(term, followed, hears, true), rules::may_follow(term, followed, hears, false),
                      rules::is_from_owner(term, followed));
        }
    }
    for (const Epoch epoch : {Epoch{0}, first_epoch(followed) - 1, first_epoch(followed),
                              first_epoch(followed) + (Epoch{1} << 24) - 1, first_epoch(followed) + (Epoch{1} << 24)}) {
        text.line(is_epoch_of(epoch, followed));
    }
    return text.text();
}

/// Owners of a few terms; some fall silent, for about as long as counts.
std::string owners_of(std::uint32_t number) {
    Random random(number);
    const ProtocolTiming t = timing_of(number % 20);
    OwnerLink link(t);
    SlotGate gate;
    RecordedText text;
    Slot now = 1;
    for (int k = 0; k < 120; ++k) {
        const bool is_silent = draw_below(random, 12) == 0;
        now += is_silent ? rules::silence_slots(t) + draw_below(random, 5) - 2 : draw_below(random, 3);
        text.line(link.receives_owner(now), gate.next(now), gate.missed(now));
        text.line(gate.enter(now));
        if (draw_below(random, 20) == 0) { link.forgive(draw_below(random, 4)); }
        MachineState state{.term = {static_cast<std::uint64_t>(1 + draw_below(random, 3)), 5}, .stamp = now};
        state.stamp -= draw_below(random, 8) == 0 ? draw_below(random, 2 * rules::silence_slots(t)) : 0;
        state.phase = static_cast<MachinePhase>(draw_below(random, 10));
        text.line(link.take(state, now, draw_below(random, 4) != 0));
        text.line(link.term().number, link.is_from_owner(state.term), link.receives_owner(now));
    }
    return text.text();
}

/// Two processes with one role, seen by one of them; and states of a peer as evidence.
std::string peers_of(std::uint32_t number) {
    constexpr std::int64_t kTick_ns = 1'000'000;
    Random random(number);
    const ProtocolTiming t = timing_of(number % 20);
    std::vector<Rival> rivals{Rival(100, kTick_ns, Tick{5000})};  // on the heap: GCC 12 warns otherwise
    SecondProcess second(t);
    PeerEvidence evidence;
    RecordedText text;
    Tick now{5000 + (number % 2 == 0 ? 4000 + draw_below(random, 2000) : 0)};
    Slot slot = 1000;
    const auto other = static_cast<Identity>(99 + draw_below(random, 2) * 2);
    for (int k = 0; k < 200; ++k) {
        now += Ticks{draw_below(random, 100)};
        slot += draw_below(random, 3);
        const Identity heard = other + (draw_below(random, 60) == 0 ? 10 : 0);
        const Slot late = draw_below(random, 6) == 0 ? draw_below(random, rules::silence_slots(t) + 3) : 0;
        const Slot early = draw_below(random, 6) == 0 ? draw_below(random, 4) : 0;
        const Slot stamp = slot - late + early;
        const bool proved = second.proves(heard, stamp, slot);
        text.line(proved, rivals.front().must_leave(heard, proved, now));
        const Epoch epoch = draw_below(random, 10) == 0 ? 8 : 7;
        evidence.receive(stamp, epoch, static_cast<FrameNumber>(draw_below(random, 4)));
        text.line(evidence.holds(7, 2, stamp + t.lease_slots() + draw_below(random, 3) - 1, t));
    }
    return text.text();
}

std::string receptions_of(std::uint32_t number) {
    constexpr std::int64_t kTick_ns = 1'000'000;
    Random random(number);
    ReceptionWatch watch(Ticks{1000 * (1 + draw_below(random, 10))}, kTick_ns);
    std::vector<TopicReception> topics(2);
    RecordedText text;
    Tick now{1};
    std::int64_t lasts = 0;
    bool silent = false, missing = false, unreceived = false, discards = false;
    for (int k = 0; k < 300; ++k) {
        if (lasts-- <= 0) {
            lasts = draw_below(random, 40);
            silent = draw_below(random, 3) == 0;
            missing = draw_below(random, 3) == 0;
            unreceived = draw_below(random, 3) == 0;
            discards = draw_below(random, 3) == 0;
        }
        now += Ticks{100 + draw_below(random, 4000)};
        if (!watch.is_due(now)) {
            text.line("early");
            continue;
        }
        for (TopicReception& topic : topics) { (discards ? topic.discarded : topic.received) += random() % 3; }
        Reception reception{{}, silent, missing, unreceived, draw_below(random, 5) != 0, topics};
        if (draw_below(random, 50) == 0) { reception.change = static_cast<ReopenReason>(draw_below(random, 2)); }
        const auto why = watch.look(now, reception);
        text.line(why, why ? text_of(*why) : "");
    }
    return text.text();
}

TEST(RulesOfTheProtocol, StayAsRecorded) { expect_recorded("tests/property/protocol/rules.txt", kTimings, rules_of); }
TEST(DecisionsOfTheProtocol, StayAsRecorded) { expect_recorded("tests/property/protocol/decisions.txt", 6, decisions); }
TEST(OwnersThatAnAxisFollows, StayAsRecorded) {
    expect_recorded("tests/property/protocol/owners.txt", kSequences, owners_of);
}
TEST(PeersOfAProcess, StayAsRecorded) { expect_recorded("tests/property/protocol/peers.txt", kSequences, peers_of); }
TEST(ReasonsToReopen, StayAsRecorded) {
    expect_recorded("tests/property/protocol/receptions.txt", kSequences, receptions_of);
}

}  // namespace
}  // namespace lockstep
