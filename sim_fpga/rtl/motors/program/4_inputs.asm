; The inputs: each follows its pin once the pin has kept its level for its DEBOUNCE. It is sim_fpga/input_filter.hpp.
look:
    mov DIFFERENT, pins
    xor DIFFERENT, INVERTS
    xor DIFFERENT, CLOSED[0]
    mov CHANGED, #0
    mov BIT, #1
    mov I, #0
look_at_input:
    tst DIFFERENT, BIT
    jz next_input
    word I
    tst PENDING, BIT
    jnz is_pending
    st TICK, [p+SINCE]
    mov A, #0
    jmp compare_debounce
is_pending:
    mov A, TICK
    ld B, [p+SINCE]
    sub A, B
compare_debounce:
    ld B, [p+DEBOUNCE]
    cmp A, B
    jnc next_input
    or CHANGED, BIT
next_input:
    add BIT, BIT
    add I, #1
    cmp I, #INPUTS
    jnc look_at_input
    xor CLOSED[0], CHANGED
    mov PENDING, DIFFERENT
    andn PENDING, CHANGED

; Notes that the inputs CHANGED have changed.
note_inputs:
    mov EXPECTED, CLOSED[0]
    xor EXPECTED, INVERTS
    cmp PENDING, #0
    jz is_expected
    or EXPECTED, #0x8000
is_expected:
    call judge_inputs
    cmp CHANGED, #0
    jz return
    mov BIT, #1
    mov I, #0
note_input:
    tst CHANGED, BIT
    jz note_next_input
    mov EVENT[0], I
    mov EVENT[1], #0
    tst CLOSED[0], BIT
    jz is_open
    mov EVENT[1], #1
is_open:
    mov EVENT_VALUE, COUNT
    mov EVENT_DETAIL, PHASE
    call note
note_next_input:
    add I, #0x100
    add BIT, BIT
    cmp BIT, #1 << INPUTS
    jnz note_input
    ret

; What the closed inputs mean.
judge_inputs:
    and SEEN, #INTO_LIMIT | FELL_SILENT
    ld X, [TAKEN_SETUP + LIMIT_MIN]
    tst CLOSED[0], X
    jz not_min
    or SEEN, #AT_MIN
not_min:
    ld X, [TAKEN_SETUP + LIMIT_MAX]
    tst CLOSED[0], X
    jz not_max
    or SEEN, #AT_MAX
not_max:
    ld X, [TAKEN_SETUP + HOME]
    tst CLOSED[0], X
    jz not_home
    or SEEN, #AT_HOME
not_home:
    ld X, [TAKEN_SETUP + STOP_INPUTS]
    tst CLOSED[0], X
    jz not_stop
    or SEEN, #STOPPED
not_stop:
    cmp TRIGGER_INPUTS, #0
    jz return
    tst CLOSED[0], TRIGGER_INPUTS[0]
    jz all_open
    tst OPENS, #1
    jnz return
is_triggered:
    or SEEN, #TRIGGERED
    ret
all_open:
    tst OPENS, #1
    jnz is_triggered
    ret

; Puts EVENT, EVENT_VALUE and EVENT_DETAIL into the event ring, with the tick.
note:
    mov X, EVENT_HEAD[0]
    small_entry EVENT_HEAD
    sub X, EVENTS_OUT
    cmp X, #EVENT_ENTRIES
    jc event_lost
    st TICK, [p+EVENTS]
    st EVENT, [p+EVENTS + 4]
    st EVENT_VALUE, [p+EVENTS + 8]
    st EVENT_DETAIL, [p+EVENTS + 12]
    add EVENT_HEAD, #1
    ret
event_lost:
    add EVENT_LOST, #1
    ret
