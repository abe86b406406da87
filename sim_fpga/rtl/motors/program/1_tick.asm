; The work of a tick: for each motor, the host's orders, then the inputs and the decisions of the present tick, then the
; tick itself, then the inputs and the decisions after it. The rules are those of sim_fpga/device.hpp.

power_up:
    first
clear_motor:
    mov I, #0
clear_word:
    word I
    st PULSES_LEFT, [p+HOST]
    st PULSES_LEFT, [p+TAKEN_SETUP]
    add I, #1
    cmp I, #256
    jnz clear_word
    mov X, #1
    mov Y, #2
    mov I, #4
    st X, [TAKEN_SETUP + LIMIT_MIN]
    st Y, [TAKEN_SETUP + LIMIT_MAX]
    st I, [TAKEN_SETUP + HOME]
    jlast rest_all
    next
    jmp clear_motor

rest_all:
    rest
idle:
    jtick tick
    jshow show
    jmp idle
show:
    shown
    call show_words
    jmp rest_all

tick:
    take
motor:
    jtouched touched
    tst FLAGS, #NEW_SETUP | STOP_ASKED | LOST | AGAIN
    jnz again
look_before:
    call tend_inputs                ; no order is new: what begins was decided after the tick before
    jmp travel
touched:
    untouch
    call read_orders
again:
    tst FLAGS, #NEW_SETUP
    jz enable
    cmp MOTION, #BODY
    jc enable
    call take_setup
enable:
    andn FLAGS, #AGAIN
    call judge_enable
    tst FLAGS, #BEATS
    jz direct
    call hear
direct:
    tst FLAGS, #ASKS_DIRECT
    jz run
    call change_directly
run:
    cmp MOTION, #BODY
    jc cease
    call take_run
cease:
    cmp MOTION, #REST
    jz judge
    tst FLAGS, #STOP_ASKED
    jz not_stopped
    mov REASON, #BY_HOST
    call end_run
    jmp judge
not_stopped:
    tst FLAGS, #LOST
    jz judge
    mov REASON, #FINISHED
    call end_run
judge:
    call tend
decide_before:
    cmp.3 LEFT, #0
    jnz travel
    call decide

travel:
    add TICK, #1
    cmp.3 LEFT, #0
    jz travelled
    add VELOCITY, ACCELERATION
    joverflow overflow
    add PHASE, VELOCITY
    jstep step
stepped:
    sub.3 LEFT, #0x100
    jlate late
    tst HAS_SLOPE, #0xff
    jz travelled
    call slide
travelled:
    cmp TICK, NEXT_DUE
    jc changes_due
look_after:
    call tend
    cmp.3 LEFT, #0
    jnz look_ahead
    call decide
next_motor:
    jlast rest_all
    next
    jmp motor

; Checks the next frame and its changes little by little, so that they are known when they begin. If all motors begin a
; frame in a tick, the next one waits, and the checks go on when none does.
look_ahead:
    jtick next_motor
    tst SCAN, #KNOWN
    jnz look_ahead_at_changes
    mov CHECKS, checks
    call settle_frames
look_ahead_at_changes:
    mov CHECKS, checks
    call settle_changes
    jmp next_motor

changes_due:
    call change_due
    jmp look_after
late:
    or FLAGS, #LOST
    jmp travelled
overflow:
    mov REASON, #BAD_SEGMENT
    call end_run
    jmp travelled

; A step: COUNT, the capture ring, and the pulse, unless it goes into a closed limit switch.
step:
    jback step_backward
    tst SEEN, #AT_MAX
    jnz into_limit
    step_forward
    mov A, TICK
    add COUNT, #1
    add A, A
    or FLAGS, #FORWARD
    or A[0], #1
    jmp capture
step_backward:
    tst SEEN, #AT_MIN
    jnz into_limit
    step_backward
    mov A, TICK
    sub COUNT, #1
    add A, A
    or FLAGS, #BACKWARD
capture:
    mov X, CAPTURE_HEAD[0]
    add CAPTURE_SUM, A
    sub X, CAPTURES_OUT
    add CAPTURE_SUMS, CAPTURE_SUM
    cmp X, #CAPTURE_ENTRIES
    jc capture_full
    word CAPTURE_HEAD
    st A, [p+CAPTURES]
    add CAPTURE_HEAD, #1
    jmp stepped
capture_full:
    add CAPTURE_LOST, #1
    or RUN_BITS, #OVERFLOWS
    jmp stepped
into_limit:
    or SEEN, #INTO_LIMIT
    jmp stepped

; What the host's silence and the inputs ask for.
tend:
    cmp TICK, SILENT_AT
    jc fall_silent
tend_inputs:
    cmp EXPECTED, pins
    jnz tend_look
tend_looked:
    tst SEEN, #AT_MIN | AT_MAX | STOPPED | TRIGGERED | INTO_LIMIT | FELL_SILENT
    jnz tend_seen
    andn FLAGS, #FORWARD | BACKWARD
    ret
tend_look:
    call look
    jmp tend_looked
fall_silent:
    mov SILENT_AT, NEVER
    or FLAGS, #SILENT
    or SEEN, #FELL_SILENT
    call end_outputs
    ld A, [TAKEN_SETUP + AT_SILENCE]
    call make_safe
    jmp tend_inputs

; Why the run ends.
tend_seen:
    cmp MOTION, #BODY
    jnc tend_ceased
    mov REASON, #0
    tst SEEN, #INTO_LIMIT
    jnz at_limit
    tst FLAGS, #BACKWARD
    jz not_at_min
    tst SEEN, #AT_MIN
    jnz at_limit
not_at_min:
    tst FLAGS, #FORWARD
    jz not_at_limit
    tst SEEN, #AT_MAX
    jz not_at_limit
at_limit:
    or REASON, #BY_LIMIT
not_at_limit:
    tst SEEN, #TRIGGERED
    jz not_triggered
    or REASON, #BY_TRIGGER
not_triggered:
    tst SEEN, #STOPPED
    jz not_by_input
    or REASON, #BY_INPUT
not_by_input:
    cmp REASON, #0
    jz tend_ceased
    call end_run
tend_ceased:
    andn FLAGS, #FORWARD | BACKWARD
    andn SEEN, #INTO_LIMIT
    tst SEEN, #FELL_SILENT
    jz return
    andn SEEN, #FELL_SILENT
    jmp judge_enable
return:
    ret
