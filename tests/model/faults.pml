/* The faults: one class per run, in any slot or never. All axes are alike, so the victim is axis 0, and the broken link
 * is between 0 and 1. A class defines which messages are affected, which process stalls, and which promise still holds:
 * Q, every frame runs, or P, all axes run the same frames. */

#define NEVER 255
#define LONG_AGO 3
byte since = NEVER; /* slots since the fault began, LONG_AGO at most */
byte stalled = 0;   /* for how many slots the stall has lasted */
bit mid_step = 0;   /* the stall began in this slot, after the decisions and before their effects */
bit kept = 0;       /* the effects wait for the end of the stall */
Message late;       /* what the stalled process was about to send */

/* ---- clocks: one axis may count one slot more or less than all others ---- */

#ifdef CLOCK_OFF
byte clock_ahead[N], clock_behind[N];
#define CLOCK(i) (slot + clock_ahead[i] - clock_behind[i])
inline set_clocks() {
    if :: i = 0 :: i = 1 :: N > 2 -> i = 2 fi;
    if :: clock_ahead[i] = 1 :: clock_behind[i] = 1 fi;
    i = 0
}
#else
#define CLOCK(i) slot
inline set_clocks() { skip }
#endif

/* ---- promises ---- */

/* The device of an axis that crashes or stalls may or may not have got the order to run the frames that the others arm
 * meanwhile. The others may be three slots ahead of it, and its checks may be late by E slots. */
#ifndef APART
#define APART ((3 + E + FRAME - 1) / FRAME)
#endif
#define BESIDE(a, b) ((a) <= (b) + APART && (b) <= (a) + APART)
#define OTHERS_RUN_THE_SAME_2 1
#define OTHERS_RUN_THE_SAME_3 (axis[1].ran == axis[2].ran)
#define OTHERS_RUN_THE_SAME_4 (OTHERS_RUN_THE_SAME_3 && axis[1].ran == axis[3].ran)
#define OTHERS_RUN_THE_SAME OF_N(OTHERS_RUN_THE_SAME)
#define ALL_RUN(frames) (axis[0].ran == (frames) && axis[1].ran == (frames) && OTHERS_RUN_THE_SAME)
#define BESIDE_AXES(a, b) BESIDE(axis[a].ran, axis[b].ran)
#define ALL_BESIDE_2 BESIDE_AXES(0, 1)
#define ALL_BESIDE_3 (ALL_BESIDE_2 && BESIDE_AXES(0, 2) && BESIDE_AXES(1, 2))
#define ALL_BESIDE_4 (ALL_BESIDE_3 && BESIDE_AXES(0, 3) && BESIDE_AXES(1, 3) && BESIDE_AXES(2, 3))
#define ALL_BESIDE OF_N(ALL_BESIDE)
/* No frame runs that the coordinator has vetoed. */
#define STOPPED (axis[1].ran < coordinator_veto)
#define P (ALL_RUN(axis[0].ran) && STOPPED)
#ifdef STOP
#define Q P
#else /* without a touch these are all frames */
#define Q ALL_RUN(touched - 1)
#endif
#define P_BUT_FOR_THE_VICTIM (OTHERS_RUN_THE_SAME && BESIDE(axis[0].ran, axis[1].ran) && STOPPED)

/* No axis runs a frame that a touched axis has vetoed, not even the victim of a fault. */
#ifdef TOUCH
byte touched = NO_VETO; /* the lowest such frame */
#else
#define touched NO_VETO
#endif
#define TOUCH_STOPS_2 (axis[0].ran < touched && axis[1].ran < touched)
#define TOUCH_STOPS_3 (TOUCH_STOPS_2 && axis[2].ran < touched)
#define TOUCH_STOPS_4 (TOUCH_STOPS_3 && axis[3].ran < touched)
#define TOUCH_STOPS OF_N(TOUCH_STOPS)

/* ---- classes ---- */

/* The slot in which the oldest evidence for a frame has reached the receivers with a short delay, and no others. */
#define IS_MID_ROUND ((slot - RULE_FIRST_EVIDENCE(START(1), V, M) - RULE_HOP) % FRAME == 0)

#if defined(NO_FAULT)
#define PROMISE Q
#define MAY_BEGIN 0

#elif defined(COORDINATOR_CRASH)
#define SENDER_FAILS
#define HIT_FROM_COORDINATOR(i) 1
#define COORDINATOR_RUNS (since == NEVER || since == 0)

#elif defined(TAKEOVER) /* a standby claims the machine: the owner has crashed, or continues, or stands down later */
#define SENDER_FAILS
#define HIT_FROM_COORDINATOR(i) 1
#define COORDINATOR_RUNS (since == NEVER || since == 0 || !stood_down)

#elif defined(AXIS_CRASH) /* its device continues */
#define PROMISE P_BUT_FOR_THE_VICTIM
#define SENDER_FAILS
#define HIT(j, i) ((j) == 0)
#define HIT_TO_COORDINATOR(j) ((j) == 0)
#define AXIS_RUNS(i) ((i) != 0 || since == NEVER || since == 0)

#elif defined(AXIS_DEAF)
#define HIT(j, i) ((i) == 0)
#define HIT_FROM_COORDINATOR(i) ((i) == 0)

#elif defined(AXIS_MUTE)
#define HIT(j, i) ((j) == 0)
#define HIT_TO_COORDINATOR(j) ((j) == 0)

#elif defined(COORDINATOR_LINK)
#define HIT_FROM_COORDINATOR(i) ((i) == 0)
#define HIT_TO_COORDINATOR(j) ((j) == 0)

#elif defined(COORDINATOR_TO_AXIS)
#define HIT_FROM_COORDINATOR(i) ((i) == 0)

#elif defined(AXIS_TO_COORDINATOR)
#define HIT_TO_COORDINATOR(j) ((j) == 0)

#elif defined(COORDINATOR_MUTE)
#define HIT_FROM_COORDINATOR(i) 1

#elif defined(COORDINATOR_DEAF)
#define HIT_TO_COORDINATOR(j) 1

#elif defined(COORDINATOR_CUT_OFF)
#define HIT_FROM_COORDINATOR(i) 1
#define HIT_TO_COORDINATOR(j) 1

#elif defined(AXIS_LINK)
#define HIT(j, i) ((j) + (i) == 1)

#elif defined(AXIS_LINK_ONE_WAY)
#define HIT(j, i) ((j) == 0 && (i) == 1)

#elif defined(AXIS_LOSS) /* any of its receivers may lose one message */
#define SENDER_FAILS
#define HIT(j, i) ((j) == 0)
#define HIT_TO_COORDINATOR(j) ((j) == 0)

#elif defined(COORDINATOR_LOSS)
#define SENDER_FAILS
#define HIT_FROM_COORDINATOR(i) 1

#elif defined(CUT_OFF) /* at one instant, both ways */
#define HIT(j, i) ((j) == 0 || (i) == 0)
#define HIT_TO_COORDINATOR(j) ((j) == 0)
#define HIT_FROM_COORDINATOR(i) ((i) == 0)
#define IN_FLIGHT(age) 0
#ifdef MID_ROUND
#define MAY_BEGIN IS_MID_ROUND
#elif defined(BETWEEN_ROUNDS)
#define MAY_BEGIN !IS_MID_ROUND
#else
#define PROMISE P_BUT_FOR_THE_VICTIM
#endif

#elif defined(AXIS_STALL)
#define AXIS_STALLS
#define LONGEST_STALL S
#define MAY_WAIT(i) ((i) != 0) /* a late check is a stall, too */
#define PROMISE Q

#elif defined(AXIS_LONG_STALL)
#define AXIS_STALLS
#define PROMISE P_BUT_FOR_THE_VICTIM

#elif defined(COORDINATOR_STALL)
#define COORDINATOR_STALLS
#define LONGEST_STALL S
#define PROMISE Q

#elif defined(COORDINATOR_LONG_STALL)
#define COORDINATOR_STALLS

#elif defined(ALL_STALL) /* a host stalls: all its processes stall for the same slots */
#define ALL_STALL_TOGETHER
#define LONGEST_STALL S
#define MAY_WAIT(i) 0 /* a late check is a stall, too */
#define PROMISE Q

#elif defined(ALL_LONG_STALL)
#define ALL_STALL_TOGETHER
#define PROMISE ALL_BESIDE

#elif defined(ANY_LOSS) /* any message to any receiver, in every slot: many faults, so only certain vetoes hold */
#define PROMISE true
#define HIT(j, i) 1
#define HIT_FROM_COORDINATOR(i) 1
#define HIT_TO_COORDINATOR(j) 1
#define MAY_BEGIN 0

#elif defined(AXIS_VETO) /* for reasons of its own */
#define OWN_REASONS

#else
#error "name a fault class"
#endif

#ifdef ALL_STALL_TOGETHER
#define AXIS_RUNS(i) (!stalled)
#define COORDINATOR_RUNS (!stalled)
#endif
#ifdef AXIS_STALLS
#define AXIS_RUNS(i) ((i) != 0 || !stalled || mid_step)
#endif
#ifdef COORDINATOR_STALLS /* within its multicast, too */
#define SENDER_FAILS
#define HIT_FROM_COORDINATOR(i) 1
#define COORDINATOR_RUNS (!stalled || mid_step)
#endif

#ifndef PROMISE
#define PROMISE P
#endif
#ifndef COORDINATOR_RUNS
#define COORDINATOR_RUNS 1
#endif
#ifndef AXIS_RUNS
#define AXIS_RUNS(i) 1
#endif
#ifndef MAY_WAIT
#define MAY_WAIT(i) 1
#endif
#ifndef MAY_BEGIN
#define MAY_BEGIN 1
#endif

/* ---- takeover: an axis at rest may follow the standby (ownership.pml), and takes nothing from the old owner then ---- */

#ifdef TAKEOVER
bit stood_down = 0;
bit follows_another[N];
#define FOLLOWS_ANOTHER(i) follows_another[i]
/* The epoch has not begun on this axis, or its device has come to the start of a frame that it did not run. */
#define RESTS(i) (axis[i].held == 0 || axis[i].ran == FRAMES || CLOCK(i) > START(axis[i].ran + 1))
inline take_over() {
    if :: since != NEVER -> stood_down = 1 :: true fi;
    for (i : 0 .. N - 1) {
        if :: since != NEVER && RESTS(i) -> follows_another[i] = 1 :: true fi
    }
    i = 0
}
#else
#define FOLLOWS_ANOTHER(i) 0
inline take_over() { skip }
#endif

/* ---- paths: the message of `age` slots ago arrives (PASSES), may arrive (MAYBE), or is lost ---- */

#ifndef HIT
#define HIT(j, i) 0
#endif
#ifndef HIT_FROM_COORDINATOR
#define HIT_FROM_COORDINATOR(i) 0
#endif
#ifndef HIT_TO_COORDINATOR
#define HIT_TO_COORDINATOR(j) 0
#endif
#ifdef ANY_LOSS
#define MAY_ARRIVE(hit, age) (hit)
#define ARRIVES(hit, age) (!(hit))
#elif defined(SENDER_FAILS) /* each receiver separately may get the message of that slot */
#define MAY_ARRIVE(hit, age) ((hit) && since == (age))
#define ARRIVES(hit, age) (!(hit) || since != (age))
#else /* the path fails: each receiver separately may get the messages in transit */
#ifndef IN_FLIGHT
#define IN_FLIGHT(age) (since < (age))
#endif
#define MAY_ARRIVE(hit, age) ((hit) && IN_FLIGHT(age))
#define ARRIVES(hit, age) (!(hit) || since == NEVER)
#endif
#define PASSES(j, i, age) ARRIVES(HIT(j, i), age)
#define MAYBE(j, i, age) MAY_ARRIVE(HIT(j, i), age)
#define FROM_COORDINATOR_PASSES(i, age) (ARRIVES(HIT_FROM_COORDINATOR(i), age) && !FOLLOWS_ANOTHER(i))
#define FROM_COORDINATOR_MAYBE(i, age) (MAY_ARRIVE(HIT_FROM_COORDINATOR(i), age) && !FOLLOWS_ANOTHER(i))
#define TO_COORDINATOR_PASSES(j, age) ARRIVES(HIT_TO_COORDINATOR(j), age)
#define TO_COORDINATOR_MAYBE(j, age) MAY_ARRIVE(HIT_TO_COORDINATOR(j), age)

/* ---- times ---- */

inline begin_fault() {
    since = 0;
#ifdef ALL_STALL_TOGETHER
    stalled = 1;
#endif
#if defined(AXIS_STALLS) || defined(COORDINATOR_STALLS)
    stalled = 1;
    if :: mid_step = 1 :: skip fi
#endif
}

inline go_on_stalling() {
    mid_step = 0;
    if
#ifdef LONGEST_STALL
    :: stalled && stalled < LONGEST_STALL -> stalled++
#else
    :: stalled
#endif
    :: stalled -> stalled = 0
    :: else
    fi
}

inline meet_fault() {
    if
    :: since == NEVER && MAY_BEGIN -> begin_fault()
    :: since == NEVER
    :: else ->
        if :: since < LONG_AGO -> since++ :: else fi;
        go_on_stalling()
    fi;
    take_over()
}

/* ---- stalls: decisions take effect late ---- */

inline send_late(message) {
    message.evidence = message.evidence | late.evidence;
    message.frames = message.frames | late.frames;
    late.evidence = 0;
    late.frames = 0;
    late.veto = 0;
    kept = 0
}

#ifdef AXIS_STALLS
inline act() {
    if
    :: i == 0 && mid_step ->
        late.evidence = axis[i].now.evidence;
        late.veto = axis[i].now.veto;
        kept = 1;
        send_nothing()
    :: else ->
        update_device();
        if :: i == 0 && kept -> send_late(axis[i].now) :: else fi
    fi
}

/* The stall may continue right after the effects. */
inline stand_still() {
    send_nothing();
    if
    :: kept ->
        axis[i].armed = axis[i].cleared;
        axis[i].device_veto = late.veto;
        axis[i].now.veto = late.veto;
        send_late(axis[i].now)
    :: true
    fi
}
#elif defined(AXIS_CRASH)
inline act() { /* or the process ends before */
    if :: update_device() :: i == 0 && since == 0 fi
}
inline stand_still() { send_nothing() }
#else
inline act() { update_device() }
inline stand_still() { send_nothing() }
#endif

inline resend_late() {
#ifdef COORDINATOR_STALLS
    if
    :: mid_step ->
        late.evidence = coordinator_now.evidence;
        late.frames = coordinator_now.frames
    :: !stalled -> send_late(coordinator_now)
    :: else
    fi
#else
    skip
#endif
}

/* ---- vetoes without a fault ---- */

/* An axis that cannot continue, or an axis whose device has not begun the frame that it armed. */
#if defined(OWN_REASONS)
#define CANNOT_GO_ON (i == 0 && since == 0)
#elif !defined(WITHOUT_VETO_WHEN_LEFT_BEHIND)
#define CANNOT_GO_ON (axis[i].ran < axis[i].cleared && CLOCK(i) > START(axis[i].cleared))
#else
#define CANNOT_GO_ON false
#endif

inline veto_for_own_reasons() {
    if
    :: CANNOT_GO_ON ->
        lowest_open(RULE_AXIS_MAY_VETO(CLOCK(i), START(k)));
        LOWEST(axis[i].veto, k)
    :: else
    fi
}

inline may_stop() {
#ifdef STOP
    if
    :: true ->
        lowest_open(RULE_VETO_IS_CERTAIN(slot, START(k), V, M));
        LOWEST(coordinator_veto, k)
    :: true
    fi
#else
    skip
#endif
}

/* An input closes at any axis, in any slot and any number of times. */
inline may_be_touched() {
#ifdef TOUCH
    if
    :: true ->
        lowest_open(RULE_VETO_IS_CERTAIN(CLOCK(i), START(k), V, M));
        LOWEST(axis[i].veto, k);
        LOWEST(touched, k)
    :: true
    fi
#else
    skip
#endif
}
