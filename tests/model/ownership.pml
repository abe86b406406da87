/* Who owns the machine: two coordinators, two axes, and a network that may bring what was ever said at any time, in any
 * order, as often as it likes, or never. Coordinators may stall for as long as they like between any two steps, and be
 * started anew; each may take the other for dead at any time. What is decided is decided by core/protocol/rules.inc.
 *
 * The promise: never does one axis move for one owner while the other moves for another, and no axis moves for a lower
 * term than it has moved for before. Terms are numbers here: of two claims the second coordinator's is the higher one. */

#include "core/protocol/rules.inc"

#ifndef CLAIMS
#define CLAIMS 4 /* the highest term */
#endif
#define NOBODY 0
#define BIT(i) (1 << (i))
#define BOTH (BIT(0) | BIT(1))

#ifdef WITHOUT_TERM_CHECK
#undef RULE_IS_FROM_OWNER
#define RULE_IS_FROM_OWNER(term, followed) ((term) != NOBODY)
#endif
#ifdef WITHOUT_REST_BEFORE_FOLLOWING
#undef RULE_MAY_FOLLOW
#define RULE_MAY_FOLLOW(term, followed, hears_owner, at_rest) ((term) > (followed) && !(hears_owner))
#endif
#ifdef WITHOUT_ACKNOWLEDGEMENT
#define MAY_MOVE(c) (own[c] != NOBODY)
#else
#define MAY_MOVE(c) (own[c] != NOBODY && acknowledged[c] == BOTH)
#endif

byte own[2];          /* the term of a coordinator that thinks it owns the machine */
byte highest[2];      /* that it has used or heard of; a start anew goes by the time, which is above what was used */
byte acknowledged[2]; /* by which axes */
bit announced[CLAIMS + 1];
byte ordered[CLAIMS + 1]; /* by term: which axes were ever told to move */

byte followed[2];  /* by each axis */
byte moves_for[2]; /* the term whose motion it makes */
byte moved_for[2]; /* the highest it has ever made */

#define CLAIM(c) (2 * (highest[c] / 2) + 2 + (c) - 1) /* odd: the first's, even: the second's */

#define KEPT                                                                                       \
    (!(moves_for[0] != NOBODY && moves_for[1] != NOBODY && moves_for[0] != moves_for[1]) &&       \
     (moves_for[0] == NOBODY || moves_for[0] >= moved_for[0]) &&                                  \
     (moves_for[1] == NOBODY || moves_for[1] >= moved_for[1]))

proctype Coordinator(bit c) {
    bit i;
    do
    :: atomic { own[c] == NOBODY && CLAIM(c) <= CLAIMS ->
        own[c] = CLAIM(c);
        highest[c] = own[c];
        acknowledged[c] = 0;
        announced[own[c]] = 1 }
    :: atomic { i = 0 -> highest[c] = (followed[i] > highest[c] -> followed[i] : highest[c]) }
    :: atomic { i = 1 -> highest[c] = (followed[i] > highest[c] -> followed[i] : highest[c]) }
    :: atomic { own[c] != NOBODY && followed[0] == own[c] -> acknowledged[c] = acknowledged[c] | BIT(0) }
    :: atomic { own[c] != NOBODY && followed[1] == own[c] -> acknowledged[c] = acknowledged[c] | BIT(1) }
    :: atomic { MAY_MOVE(c) -> ordered[own[c]] = ordered[own[c]] | BIT(0) }
    :: atomic { MAY_MOVE(c) -> ordered[own[c]] = ordered[own[c]] | BIT(1) }
    :: atomic { own[c] != NOBODY -> own[c] = NOBODY } /* it stands down, or is started anew */
    od
}

proctype Axis(bit i) {
    byte term;
    do
    :: atomic {
        select (term : 1 .. CLAIMS);
        if
        :: announced[term] && RULE_MAY_FOLLOW(term, followed[i], 0, moves_for[i] == NOBODY) -> followed[i] = term
        :: else
        fi;
        term = 0 }
    :: atomic {
        select (term : 1 .. CLAIMS);
        if
        :: (ordered[term] & BIT(i)) && moves_for[i] == NOBODY && RULE_IS_FROM_OWNER(term, followed[i]) ->
            moves_for[i] = term;
            assert(KEPT);
            moved_for[i] = term
        :: else
        fi;
        term = 0 }
    :: atomic { moves_for[i] != NOBODY -> moves_for[i] = NOBODY }
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
