/* Ownership of the machine: two coordinators, two axes, and a network that may deliver every message at any time, in any
 * order, any number of times, or never. A coordinator may stall for any time between any two steps, and restart; each
 * may assume at any time that the other has ended. All decisions are made by core/protocol/rules.inc.
 *
 * The promise: the two axes never move for different owners at the same time, and no axis moves for a lower
 * term than before. Terms are numbers here. Of two claims after the same term, the second coordinator's is higher. */

#include "core/protocol/rules.inc"

#ifndef CLAIMS
#define CLAIMS 4 /* the highest term */
#endif
#define NO_OWNER 0
#define BIT(i) (1 << (i))
#define BOTH (BIT(0) | BIT(1))

#ifdef WITHOUT_TERM_CHECK
#undef RULE_IS_FROM_OWNER
#define RULE_IS_FROM_OWNER(term, followed) ((term) != NO_OWNER)
#endif
#ifdef WITHOUT_REST_BEFORE_FOLLOWING
#undef RULE_MAY_FOLLOW
#define RULE_MAY_FOLLOW(term, followed, hears_owner, at_rest) ((term) > (followed) && !(hears_owner))
#endif
#ifdef WITHOUT_ACKNOWLEDGEMENT
#define MAY_MOVE(c) (own[c] != NO_OWNER)
#else
#define MAY_MOVE(c) (own[c] != NO_OWNER && acknowledged[c] == BOTH)
#endif

byte own[2];          /* the term of a coordinator that assumes it owns the machine */
byte highest[2];      /* the highest term that it used or received; a restart uses the time, which is higher than all */
byte acknowledged[2]; /* the axes that acknowledged the term */
bit announced[CLAIMS + 1];
byte ordered[CLAIMS + 1]; /* by term: the axes that were ever ordered to move */

byte followed[2];  /* the term that each axis follows */
byte moves_for[2]; /* the term for which each axis moves now */
byte moved_for[2]; /* the highest term for which each axis has moved */

#define CLAIM(c) (2 * (highest[c] / 2) + 2 + (c) - 1) /* the first claims odd terms, the second even ones */

#define KEPT                                                                                       \
    (!(moves_for[0] != NO_OWNER && moves_for[1] != NO_OWNER && moves_for[0] != moves_for[1]) &&       \
     (moves_for[0] == NO_OWNER || moves_for[0] >= moved_for[0]) &&                                  \
     (moves_for[1] == NO_OWNER || moves_for[1] >= moved_for[1]))

proctype Coordinator(bit c) {
    bit i;
    do
    :: atomic { own[c] == NO_OWNER && CLAIM(c) <= CLAIMS ->
        own[c] = CLAIM(c);
        highest[c] = own[c];
        acknowledged[c] = 0;
        announced[own[c]] = 1 }
    :: atomic { i = 0 -> highest[c] = (followed[i] > highest[c] -> followed[i] : highest[c]) }
    :: atomic { i = 1 -> highest[c] = (followed[i] > highest[c] -> followed[i] : highest[c]) }
    :: atomic { own[c] != NO_OWNER && followed[0] == own[c] -> acknowledged[c] = acknowledged[c] | BIT(0) }
    :: atomic { own[c] != NO_OWNER && followed[1] == own[c] -> acknowledged[c] = acknowledged[c] | BIT(1) }
    :: atomic { MAY_MOVE(c) -> ordered[own[c]] = ordered[own[c]] | BIT(0) }
    :: atomic { MAY_MOVE(c) -> ordered[own[c]] = ordered[own[c]] | BIT(1) }
    :: atomic { own[c] != NO_OWNER -> own[c] = NO_OWNER } /* it gives up the machine, or restarts */
    od
}

proctype Axis(bit i) {
    byte term;
    do
    :: atomic {
        select (term : 1 .. CLAIMS);
        if
        :: announced[term] && RULE_MAY_FOLLOW(term, followed[i], 0, moves_for[i] == NO_OWNER) -> followed[i] = term
        :: else
        fi;
        term = 0 }
    :: atomic {
        select (term : 1 .. CLAIMS);
        if
        :: (ordered[term] & BIT(i)) && moves_for[i] == NO_OWNER && RULE_IS_FROM_OWNER(term, followed[i]) ->
            moves_for[i] = term;
            assert(KEPT);
            moved_for[i] = term
        :: else
        fi;
        term = 0 }
    :: atomic { moves_for[i] != NO_OWNER -> moves_for[i] = NO_OWNER }
    od
}

init {
    atomic {
        run Coordinator(0);
        run Coordinator(1);
        run Axis(0);
        run Axis(1)
    }
}
