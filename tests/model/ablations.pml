/* The model without one rule. Then a promise must break, which shows the purpose of the rule. */

#ifdef WITHOUT_VETO
#define VETO_WHEN_FAILED skip
#else
#define VETO_WHEN_FAILED LOWEST(axis[i].veto, k)
#endif
#if defined(WITHOUT_VETO)
#define VETO_WHEN_TOO_LATE k = NO_VETO
#elif defined(TOO_LATE_VETOES_THE_FRAME_ITSELF)
#define VETO_WHEN_TOO_LATE skip
#elif defined(TOO_LATE_VETOES_THE_NEXT)
#define VETO_WHEN_TOO_LATE k++
#else
#define VETO_WHEN_TOO_LATE lowest_open(RULE_AXIS_MAY_VETO(CLOCK(i), START(k)))
#endif

#ifdef WITHOUT_TWO_WHOLE_HOPS /* and so V is one slot less */
#undef RULE_LAST_CHECK
#define RULE_LAST_CHECK (2 * RULE_HOP - 1)
#endif

#ifdef WITHOUT_ENOUGH_FRESHNESS
#define M S
#endif

#ifdef WITHOUT_ONE_INSTANT_OF_EVALUATION /* silence since the check is evaluated again before the start */
#define EVALUATES_SILENCE_AGAIN
#endif

#ifdef LATER_CERTAIN_VETOES /* a stop or a touch also vetoes a frame that an axis may have armed */
#undef RULE_VETO_IS_CERTAIN
#define RULE_VETO_IS_CERTAIN(now, start, v, m) ((now) <= RULE_FIRST_EVIDENCE(start, v, m) + 1)
#endif
#ifdef TOUCH_VETOES_AS_LATE_AS_A_CHECK
#undef RULE_VETO_IS_CERTAIN
#define RULE_VETO_IS_CERTAIN(now, start, v, m) RULE_AXIS_MAY_VETO(now, start)
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
