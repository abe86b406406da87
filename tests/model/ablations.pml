/* What each rule is for: the model without it, in which a promise must break. */

#ifdef WITHOUT_VETO
#undef RULE_VETO_WHEN_FAILED
#define RULE_VETO_WHEN_FAILED(k) NO_VETO
#undef RULE_VETO_WHEN_TOO_LATE
#define RULE_VETO_WHEN_TOO_LATE(k) NO_VETO
#endif

#ifdef WITHOUT_TWO_WHOLE_HOPS /* and so V is one slot less */
#undef RULE_LAST_CHECK
#define RULE_LAST_CHECK (2 * RULE_HOP - 1)
#endif

#ifdef WITHOUT_TOO_LATE_VETOES_THE_NEXT
#undef RULE_VETO_WHEN_TOO_LATE
#define RULE_VETO_WHEN_TOO_LATE(k) (k)
#endif

#ifdef WITHOUT_ENOUGH_FRESHNESS
#define M S
#endif

#ifdef WITHOUT_ONE_INSTANT_OF_EVALUATION /* silence since the check is evaluated again before the start */
#define EVALUATES_SILENCE_AGAIN
#endif

#ifdef WITHOUT_EARLY_STOPS /* the coordinator vetoes until the first axis decides */
#undef RULE_COORDINATOR_MAY_VETO
#define RULE_COORDINATOR_MAY_VETO(now, start, v, m) RULE_IS_EARLY(now, start, v)
#endif

#ifdef LAST_CHECK_EARLIER_BY
#undef RULE_LAST_CHECK
#define RULE_LAST_CHECK (2 * RULE_HOP + LAST_CHECK_EARLIER_BY)
#endif
#ifdef FRESHER_BY
#define M (RULE_LEAST_FRESHNESS(S) + FRESHER_BY)
#endif
#ifdef WITHOUT_SEND_AHEAD_FOR_A_STALL /* of more than two slots */
#define A (RULE_SEND_DEADLINE(V, M) + 2)
#endif
