/* The setpoint protocol (lease, arm, veto) for exhaustive search: a coordinator, N axes, FRAMES frames, one slot a step.
 *
 * The processes decide by core/protocol/rules.inc, the same file as the code. Each receiver uses a message in the slot
 * after the one in which it was sent, or in the next one (up to DELAY); the search tries both. One fault class is
 * compiled in (faults.pml). README.md describes how model and code correspond. */

#include "core/protocol/rules.inc"

#ifndef N
#define N 2
#endif
#ifndef FRAMES
#define FRAMES 2
#endif
#ifndef S
#define S 1
#endif
#ifndef E
#define E 0
#endif
#ifdef LATER_CHECKS
#define LATEST_CHECK (E + 1)
#else
#define LATEST_CHECK E
#endif
#ifndef DELAY
#define DELAY RULE_HOP
#endif

/* What is said of each axis by name: OF_N(NAME) is NAME_2, NAME_3 or NAME_4. */
#define JOINED(name, n) name##_##n
#define NUMBERED(name, n) JOINED(name, n)
#define OF_N(name) NUMBERED(name, N)

#include "tests/model/ablations.pml"

/* The shortest times that the configuration allows, unless other times are defined. */
#ifndef M
#define M RULE_LEAST_FRESHNESS(S)
#endif
#ifndef V
#define V RULE_CHECK_AHEAD(E)
#endif
#ifndef A
#define A RULE_LEAST_SEND_AHEAD(V, M, S)
#endif
#ifndef FRAME
#define FRAME 2
#endif
#define START(k) (A + 2 + ((k) - 1) * FRAME)
#define END (START(FRAMES) + 2) /* every device has decided on every frame, also on a clock one slot behind */

#define NO_VETO (FRAMES + 1)
#define BIT(k) (1 << ((k) - 1)) /* sets of frames */

/* The message of one slot. A state is reduced to the frames that it is evidence for, and its veto. */
typedef Message {
    byte evidence; /* a set */
    byte frames;   /* a set: the frames that the coordinator sends */
    byte veto
};

typedef Axis {
    byte held; /* every frame up to this one */
    bit open;  /* it follows the epoch: it has taken frame 1 */
    byte checked;
    byte veto;
    byte received[N + 1]; /* evidence received of each other axis and, at N, of the coordinator */
    byte cleared;      /* the highest frame that it has decided to arm */
#if LATEST_CHECK > 0
    byte waited; /* slots by which its decision is late now */
#endif
    byte armed, device_veto, ran; /* the device: its commands, and the highest frame that it has begun */
    Message now, sent[2]          /* sent in this slot, in the last one, and in the one before */
};

Axis axis[N];
Message coordinator_now, coordinator_sent[2];
byte coordinator_veto = NO_VETO;
byte slot = 0;
byte i, j, k; /* scratch, zero between slots */

#define LOWEST(into, other) if :: RULE_VETO_WINS(other, into) -> into = other :: else fi

#include "tests/model/faults.pml"

/* ---- the coordinator: EpochRunner::send and stop ---- */

#define SENDS(k) \
    (slot >= RULE_FIRST_SEND(START(k), A) && RULE_MAY_SEND(slot, START(k), V, M) && !RULE_IS_VETOED(k, coordinator_veto))

#define EVIDENCE_AT(stamp, k, veto) \
    (RULE_IS_EVIDENCE(stamp, START(k), V, M) && !RULE_IS_VETOED(k, veto) -> BIT(k) : 0)

/* The coordinator repeats the lowest veto that it received. */
inline coordinator_receives() {
#ifndef WITHOUT_COORDINATOR_REPEATING
    for (j : 0 .. N - 1) {
        if
        :: TO_COORDINATOR_PASSES(j, 2) || TO_COORDINATOR_MAYBE(j, 2) -> LOWEST(coordinator_veto, axis[j].sent[1].veto)
        :: !TO_COORDINATOR_PASSES(j, 2)
        fi;
        if
        :: TO_COORDINATOR_PASSES(j, 1) || TO_COORDINATOR_MAYBE(j, 1) ->
            LOWEST(coordinator_veto, axis[j].sent[0].veto)
        :: DELAY == 2 && RULE_VETO_WINS(axis[j].sent[0].veto, coordinator_veto)
        :: !TO_COORDINATOR_PASSES(j, 1)
        fi
    }
#else
    skip
#endif
}

inline coordinator_sends() {
    coordinator_receives();
    coordinator_now.evidence = 0;
    coordinator_now.frames = 0;
    coordinator_now.veto = NO_VETO;
    if
    :: COORDINATOR_RUNS ->
        may_stop();
        for (k : 1 .. FRAMES) {
            coordinator_now.evidence = coordinator_now.evidence | EVIDENCE_AT(slot, k, coordinator_veto);
            if :: SENDS(k) -> coordinator_now.frames = coordinator_now.frames | BIT(k) :: else fi
        }
        coordinator_now.veto = coordinator_veto
    :: else
    fi;
    resend_late()
}

/* ---- an axis: SetpointFollower::hear, offer, decide, and the state it publishes ---- */

#define UNKNOWN(message, i, j) ((message.evidence & ~axis[i].received[j]) >> axis[i].checked)
#define NEWS(message, i, j) (UNKNOWN(message, i, j) || (axis[i].open && RULE_VETO_WINS(message.veto, axis[i].veto)))

inline receive(message) { /* i receives the message of j */
    axis[i].received[j] = axis[i].received[j] | message.evidence;
    if :: axis[i].open -> LOWEST(axis[i].veto, message.veto) :: else fi
}

/* A second reception of the same message changes nothing, so the messages of two slots ago can be received again. */
inline receive_from_axis() {
    if
    :: PASSES(j, i, 2) || MAYBE(j, i, 2) -> receive(axis[j].sent[1])
    :: !PASSES(j, i, 2)
    fi;
    if
    :: (PASSES(j, i, 1) || MAYBE(j, i, 1)) && NEWS(axis[j].sent[0], i, j) -> receive(axis[j].sent[0])
    :: DELAY == 2 || !PASSES(j, i, 1) || !NEWS(axis[j].sent[0], i, j)
    fi
}

inline take(message) { /* frames are taken in order */
    if :: axis[i].held < FRAMES && (message.frames & BIT(axis[i].held + 1)) -> axis[i].held++ :: else fi;
    if :: axis[i].held < FRAMES && (message.frames & BIT(axis[i].held + 1)) -> axis[i].held++ :: else fi
}

inline take_coordinator_message(message) {
    axis[i].received[N] = axis[i].received[N] | message.evidence;
    if :: axis[i].open -> LOWEST(axis[i].veto, message.veto) :: else fi;
    take(message)
}

#define COORDINATOR_NEWS(message) \
    ((message.frames >> axis[i].held) || UNKNOWN(message, i, N) || (axis[i].open && RULE_VETO_WINS(message.veto, axis[i].veto)))

inline receive_from_coordinator() {
    if
    :: (FROM_COORDINATOR_PASSES(i, 2) || FROM_COORDINATOR_MAYBE(i, 2)) -> take_coordinator_message(coordinator_sent[1])
    :: !FROM_COORDINATOR_PASSES(i, 2)
    fi;
    if
    :: (FROM_COORDINATOR_PASSES(i, 1) || FROM_COORDINATOR_MAYBE(i, 1)) && COORDINATOR_NEWS(coordinator_sent[0]) ->
        take_coordinator_message(coordinator_sent[0])
    :: DELAY == 2 || !FROM_COORDINATOR_PASSES(i, 1) || !COORDINATOR_NEWS(coordinator_sent[0])
    fi
}

inline receive_all() {
    for (j : 0 .. N - 1) {
        if :: j != i -> receive_from_axis() :: else fi
    }
    receive_from_coordinator()
}

#define HOLDS(j, k) ((j) == i || (axis[i].received[j] & BIT(k)))
#ifdef WITHOUT_THE_COORDINATORS_EVIDENCE
#define COORDINATOR_HOLDS(k) 1
#else
#define COORDINATOR_HOLDS(k) HOLDS(N, k)
#endif
#define THESE_HOLD_2(k) (HOLDS(0, k) && HOLDS(1, k))
#define THESE_HOLD_3(k) (THESE_HOLD_2(k) && HOLDS(2, k))
#define THESE_HOLD_4(k) (THESE_HOLD_3(k) && HOLDS(3, k))
#define ALL_HOLD(k) (OF_N(THESE_HOLD)(k) && COORDINATOR_HOLDS(k))
#ifdef WITHOUT_EARLY_ARMING
#define MAY_ARM(k) (!RULE_IS_EARLY(CLOCK(i), START(k), V) && RULE_MAY_ARM(k, axis[i].held, axis[i].veto, ALL_HOLD(k)))
#else
#define MAY_ARM(k) RULE_MAY_ARM(k, axis[i].held, axis[i].veto, ALL_HOLD(k))
#endif

inline lowest_open(may_veto) {
    k = 1;
    do :: k <= FRAMES && !(may_veto) -> k++ :: else -> break od
}

/* Arms the next frame as soon as allowed, vetoes it at its check, or acts on a check that is too late. */
inline decide_next() {
    k = axis[i].checked + 1;
    if
    :: RULE_IS_TOO_LATE(CLOCK(i), START(k)) ->
        axis[i].checked = k;
        VETO_WHEN_TOO_LATE;
        LOWEST(axis[i].veto, k)
    :: else ->
        if
        :: MAY_ARM(k) ->
            axis[i].checked = k;
            axis[i].cleared = k
        :: else ->
            if
            :: RULE_IS_EARLY(CLOCK(i), START(k), V) -> break
            :: else ->
                axis[i].checked = k;
                VETO_WHEN_FAILED
            fi
        fi
    fi
}

inline decide_all() {
    do
    :: axis[i].checked < FRAMES && axis[i].checked <= axis[i].held -> decide_next()
    :: else -> break
    od
}

/* Every decision may come up to LATEST_CHECK slots late: E, unless a search asks for more. */
inline decide() {
#if LATEST_CHECK > 0
    if
    :: MAY_WAIT(i) && axis[i].waited < LATEST_CHECK -> axis[i].waited++
    :: true ->
        axis[i].waited = 0;
        decide_all()
    fi
#else
    decide_all()
#endif
}

#define EVIDENCE(k) (axis[i].held >= (k) -> EVIDENCE_AT(CLOCK(i), k, axis[i].veto) : 0)

#ifdef EVALUATES_SILENCE_AGAIN
#define MARKS_STILL_THERE(k) BIT(FRAMES + (k))
#define STILL_THERE(k) \
    (CLOCK(i) >= RULE_CHECK_SLOT(START(k), V) && CLOCK(i) < START(k) - 2 -> MARKS_STILL_THERE(k) : 0)
inline evaluate_silence() {
    for (k : 1 .. FRAMES) {
        if
        :: CLOCK(i) == START(k) - 1 ->
            for (j : 0 .. N - 1) {
                if :: j != i && !(axis[i].received[j] & MARKS_STILL_THERE(k)) -> LOWEST(axis[i].veto, k) :: else fi
            }
        :: else
        fi
    }
}
#else
#define STILL_THERE(k) 0
inline evaluate_silence() { skip }
#endif

inline publish() {
    axis[i].now.evidence = 0;
    axis[i].now.veto = NO_VETO;
    if
    :: axis[i].open ->
        for (k : 1 .. FRAMES) { axis[i].now.evidence = axis[i].now.evidence | EVIDENCE(k) | STILL_THERE(k) }
        axis[i].now.veto = axis[i].veto
    :: else
    fi
}

inline forget() { /* evidence for decided frames is not needed */
    for (j : 0 .. N) { axis[i].received[j] = (axis[i].received[j] >> axis[i].checked) << axis[i].checked }
}

inline update_device() {
    axis[i].armed = axis[i].cleared;
    axis[i].device_veto = axis[i].veto
}

inline send_nothing() {
    axis[i].now.evidence = 0;
    axis[i].now.veto = NO_VETO
}

inline axis_steps() {
    receive_all();
    if
    :: AXIS_RUNS(i) ->
        axis[i].open = axis[i].held > 0;
        if :: axis[i].open -> veto_for_own_reasons(); may_be_touched(); decide(); evaluate_silence() :: else fi;
        publish();
        act()
    :: else -> stand_still()
    fi;
    forget()
}

/* ---- the device: SimulatedDevice at the start of a frame ---- */

inline device_steps() {
    for (k : 1 .. FRAMES) {
        if
        :: CLOCK(i) == START(k) && RULE_DEVICE_RUNS(k, axis[i].ran, axis[i].armed, axis[i].device_veto) ->
            axis[i].ran = k
        :: else
        fi
    }
}

inline next_slot() {
    for (i : 0 .. N - 1) {
        axis[i].sent[1].evidence = axis[i].sent[0].evidence;
        axis[i].sent[1].veto = axis[i].sent[0].veto;
        axis[i].sent[0].evidence = axis[i].now.evidence;
        axis[i].sent[0].veto = axis[i].now.veto;
        axis[i].now.evidence = 0;
        axis[i].now.veto = 0
    }
    coordinator_sent[1].evidence = coordinator_sent[0].evidence;
    coordinator_sent[1].frames = coordinator_sent[0].frames;
    coordinator_sent[1].veto = coordinator_sent[0].veto;
    coordinator_sent[0].evidence = coordinator_now.evidence;
    coordinator_sent[0].frames = coordinator_now.frames;
    coordinator_sent[0].veto = coordinator_now.veto;
    coordinator_now.evidence = 0;
    coordinator_now.frames = 0;
    coordinator_now.veto = 0;
    i = 0;
    j = 0;
    k = 0;
    slot++
}

/* The output of a counterexample for each slot. */
inline print_slot() {
    printf("slot %d, fault since %d, coordinator: frames %d evidence %d veto %d\n", slot, since,
           coordinator_now.frames, coordinator_now.evidence, coordinator_now.veto);
    for (i : 0 .. N - 1) {
        printf("    axis %d: held %d checked %d armed %d vetoes %d ran %d, received", i, axis[i].held, axis[i].checked,
               axis[i].armed, axis[i].veto, axis[i].ran);
        for (j : 0 .. N) { printf(" %d", axis[i].received[j]) }
        printf(", sends: evidence %d veto %d\n", axis[i].now.evidence, axis[i].now.veto)
    }
}

inline begin() {
    for (i : 0 .. N - 1) {
        axis[i].veto = NO_VETO;
        axis[i].device_veto = NO_VETO;
        axis[i].sent[0].veto = NO_VETO;
        axis[i].sent[1].veto = NO_VETO
    }
    coordinator_sent[0].veto = NO_VETO;
    coordinator_sent[1].veto = NO_VETO;
    i = 0
}

/* A slot is N + 2 steps: the coordinator, each axis, the devices. No process reads what another one sends in the same
 * slot, so the order has no effect. Each step is one choice of messages, and the search merges equal states after it. */
init {
    atomic { begin(); set_clocks() }
    do
    :: atomic { slot < END -> meet_fault(); coordinator_sends(); i = 0; j = 0; k = 0 }
        do
        :: atomic { i < N -> axis_steps(); j = 0; k = 0; i++ }
        :: atomic { i == N -> break }
        od;
        atomic {
            for (i : 0 .. N - 1) { device_steps() }
            print_slot();
            next_slot()
        }
    :: else -> break
    od;
    assert(PROMISE && TOUCH_STOPS)
}
