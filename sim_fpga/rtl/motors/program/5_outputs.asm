; The outputs: levels, and analog values that change by their slope in each tick. It is sim_fpga/output_unit.hpp,
; without pulses at places, and sim_fpga/output_ring.hpp.

; What the host asks for directly, unless it was silent.
change_directly:
    andn FLAGS, #ASKS_DIRECT
    tst FLAGS, #SILENT
    jnz return
    ld A, [DIRECT_OUTPUTS]
    mov NEW_LEVELS, A[0]
    mov NEW_MASK, A[1]
    and NEW_MASK, #(1 << DIGITAL) - 1
    mov SAFE_ANALOG, A[2]
    and SAFE_ANALOG, #(1 << ANALOG) - 1
    call change_levels
    call first_channel
change_next_directly:
    tst SAFE_ANALOG, CHANNEL_BIT
    jz changed_directly
    mov X, CHANNEL
    add X, CHANNEL
    word X
    ld VALUE, [p+ANALOG_TABLE + 4]
    mov SLOPE, #0
    call change_analog
changed_directly:
    call next_channel
    jnc change_next_directly
    ret

first_channel:
    mov CHANNEL, #0
    mov CHANNEL_BIT, #1
    mov CHANNEL_HIGH, #0
    ret
next_channel:
    add CHANNEL_BIT, CHANNEL_BIT
    add CHANNEL_HIGH, #0x100
    add CHANNEL, #1
    cmp CHANNEL, #ANALOG
    ret

; Levels: NEW_LEVELS of the outputs of NEW_MASK.
change_levels:
    mov X, LEVELS[0]
    and NEW_LEVELS, NEW_MASK
    andn X, NEW_MASK
    or X, NEW_LEVELS
    cmp X, LEVELS[0]
    jz return
    mov LEVELS[0], X
    mov EVENT[0], #1
    mov EVENT[1], X
    mov EVENT_VALUE, COUNT
    mov EVENT_DETAIL, #0
    call show_levels
    jmp note
show_levels:
    mov X, LEVELS[0]
    xor X, OUTPUT_PINS_INVERTED
    levels X
    ret

; An analog output: VALUE, within 0 and full scale, and SLOPE.
change_analog:
    cmp VALUE[3], #0x8000
    jc change_to_zero
    cmp VALUE[3], #0x4000
    jnc change_to_value
    mov VALUE, #0
    mov VALUE[3], #0x4000
    jmp change_to_value
change_to_zero:
    mov VALUE, #0
change_to_value:
    or IS_ZERO, CHANNEL_BIT
    cmp VALUE, #0
    jz value_is_zero
    andn IS_ZERO, CHANNEL_BIT
value_is_zero:
    or HAS_SLOPE, CHANNEL_BIT
    cmp SLOPE, #0
    jnz has_slope
    andn HAS_SLOPE, CHANNEL_BIT
has_slope:
    word CHANNEL
    st SLOPE, [p+SLOPES]
    call keep_value
    mov EVENT[0], CHANNEL_HIGH
    mov EVENT[1], #0
    or EVENT[0], #2
    mov EVENT_VALUE, VALUE
    mov EVENT_DETAIL, SLOPE
    jmp note

; VALUE of CHANNEL, whose address is in p.
keep_value:
    st VALUE, [p+VALUES]
    mov.2 C, VALUE[2]
    add.2 C, C
    analog C[1]
    ret

; Moves analog outputs by their slopes.
slide:
    call first_channel
slide_next:
    tst HAS_SLOPE, CHANNEL_BIT
    jz slid
    word CHANNEL
    ld VALUE, [p+VALUES]
    ld SLOPE, [p+SLOPES]
    add VALUE, SLOPE
    jback slides_down
    cmp VALUE[3], #0x4000
    jnc slides
    mov VALUE, #0
    mov VALUE[3], #0x4000
    jmp slides
slides_down:
    jc slides
    mov VALUE, #0
slides:
    call keep_value
slid:
    call next_channel
    jnc slide_next
    ret

; Slopes end. No change of a frame is due.
end_outputs:
    mov NEXT_DUE, NEVER
    call first_channel
end_next:
    tst HAS_SLOPE, CHANNEL_BIT
    jz has_ended
    word CHANNEL
    ld VALUE, [p+VALUES]
    mov SLOPE, #0
    call change_analog
has_ended:
    call next_channel
    jnc end_next
    ret

; Outputs become safe: A is a word like OUTPUTS_AT_CUT.
make_safe:
    mov NEW_LEVELS, A[0]
    mov NEW_MASK, A[1]
    mov SAFE_ANALOG, A[2]
    call change_levels
    call first_channel
make_next_safe:
    tst SAFE_ANALOG, CHANNEL_BIT
    jz is_safe
    tst IS_ZERO, CHANNEL_BIT
    jnz is_safe
    mov VALUE, #0
    mov SLOPE, #0
    call change_analog
is_safe:
    call next_channel
    jnc make_next_safe
    ret

; The changes of the present frame's body or tail count from now on.
begin_changes:
    mov DUE, FIRST
    mov BASE, TICK
    mov NEXT_DUE, #0
    mov X, FLAGS
    and X, #SILENT | USABLE
    cmp X, #USABLE
    jz return
no_changes:
    mov NEXT_DUE, NEVER
    ret

change_due:
    cmp DUE, BEHIND
    jz no_changes
    small_entry DUE
    ld A, [p+CHANGES]
    ld B, [p+CHANGES + 4]
    mov X, A[0]
    and X, #0xff01
    cmp X, DUE_TAG
    jnz is_of_other
    cmp A[1], RUN_TAG[1]
    jnz is_of_other
    cmp.2 A[2], FRAME
    jnz is_of_other
    add B, BASE
    mov NEXT_DUE, B
    cmp TICK, B
    jnc return
    ld VALUE, [p+CHANGES + 8]
    ld SLOPE, [p+CHANGES + 12]
    tst A[0], #6
    jnz change_is_analog
    mov NEW_LEVELS, VALUE[0]
    mov NEW_MASK, VALUE[1]
    call change_levels
is_of_other:
    add DUE, #1
    jmp change_due
change_is_analog:
    call first_channel
    tst A[0], #8
    jz change_it
    call next_channel
change_it:
    call change_analog
    jmp is_of_other

; The next frame's changes were found and checked: they are those of the present frame now.
take_changes:
    mov FIRST, CHANGE
    mov BEHIND, CHANGE
    or FLAGS, #USABLE
    tst CHANGE_SCAN, #CHANGES_BAD
    jz are_well
    andn FLAGS, #USABLE
    or RUN_BITS, #BAD_OUTPUT
are_well:
    tst CHANGE_SCAN, #CHANGES_FOUND
    jz restart_changes
    mov FIRST, CHANGE_FIRST
restart_changes:
    mov CHANGE, BEHIND
    mov CHANGE_SCAN, #0
    mov LAST_IN_BODY, #0
    mov LAST_IN_TAIL, #0
    ret

; Finds the next frame's changes and checks them. At rest, takes those of the run off the ring.
settle_changes:
    mov X, CHANGES_IN
    sub X, CHANGE
    jz return
    cmp X, #OUTPUT_ENTRIES + 1
    jc return
    tst CHANGE_SCAN, #CHANGES_END
    jnz return
    sub CHECKS, #1
    jnc unsettled
    call check_change
    jmp settle_changes
unsettled:
    andn SCAN, #GOOD
    ret

check_change:
    small_entry CHANGE
    ld A, [p+CHANGES]
    ld B, [p+CHANGES + 4]
    ld C, [p+CHANGES + 8]
    mov X, A[0]
    and X, #0xff00
    cmp X, RUN_TAG[0]
    jnz is_of_other_run
    cmp A[1], RUN_TAG[1]
    jnz is_of_other_run
    cmp MOTION, #REST
    jz drop_change
    mov.2 VALUE, A[2]
    sub.2 VALUE, FRAME
    sub.2 VALUE, #1
    jz is_of_frame
    tst VALUE[1], #0x8000
    jnz next_change
changes_end:
    or CHANGE_SCAN, #CHANGES_END
    ret
drop_change:
    add CHANGE, #1
    mov BEHIND, CHANGE
    ret
is_of_other_run:
    cmp MOTION, #REST
    jz changes_end
next_change:
    add CHANGE, #1
    ret
is_of_frame:
    tst CHANGE_SCAN, #CHANGES_FOUND
    jnz is_not_first
    mov CHANGE_FIRST, CHANGE
    or CHANGE_SCAN, #CHANGES_FOUND
is_not_first:
    add CHANGE, #1
    cmp B, #0
    jz change_is_bad
    cmp B[3], #0                    ; at most 2^42 ticks
    jnz change_is_bad
    mov VALUE, B
    sub VALUE, #1
    cmp VALUE[2], #0x400
    jc change_is_bad
    tst A[0], #1
    jnz change_of_tail
    cmp B, LAST_IN_BODY
    jnc change_is_bad
    mov LAST_IN_BODY, B
    jmp check_kind
change_of_tail:
    cmp B, LAST_IN_TAIL
    jnc change_is_bad
    mov LAST_IN_TAIL, B
check_kind:
    tst A[0], #4
    jnz change_is_bad
    tst A[0], #2
    jnz check_channel
    tst C[1], #0xffff & ~((1 << DIGITAL) - 1)
    jz return
change_is_bad:
    or CHANGE_SCAN, #CHANGES_BAD
    ret
check_channel:
    mov X, A[0]
    and X, #0x38
    cmp X, #8 * ANALOG
    jc change_is_bad
    ret
