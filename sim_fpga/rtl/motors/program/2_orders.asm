; The host's orders, after it has written words of this motor.
read_orders:
    ld REQUEST, [RUN_REQUEST]
    ld ARMED, [ARM]
    ld VETO, [VETOES]
    ld A, [STOP]
    ld SEGMENTS_IN, [SEGMENT_HEAD]
    ld CAPTURES_OUT, [CAPTURE_TAIL]
    ld CHANGES_IN, [OUTPUT_HEAD]
    ld EVENTS_OUT, [EVENT_TAIL]
    ld B, [ENABLE]
    andn FLAGS, #STOP_ASKED | ENABLE_ASKED | NEW_SETUP | BAD_SETUP
    cmp A, #0
    jz no_stop
    cmp A, REQUEST
    jnz no_stop
    or FLAGS, #STOP_ASKED
no_stop:
    cmp B, #0
    jz no_enable
    or FLAGS, #ENABLE_ASKED
no_enable:
    ld A, [SETUP_REQUEST]
    cmp A, SETUP
    jz no_setup
    ld B, [REFUSED]
    cmp A, B
    jz refused_before
    or FLAGS, #NEW_SETUP
    jmp no_setup
refused_before:
    or FLAGS, #BAD_SETUP
no_setup:
    ld A, [BEAT]
    ld B, [BEAT_SEEN]
    cmp A, B
    jz no_beat
    st A, [BEAT_SEEN]
    or FLAGS, #BEATS
no_beat:
    ld A, [DIRECT_REQUEST]
    ld B, [DIRECT_SEEN]
    cmp A, B
    jz return
    st A, [DIRECT_SEEN]
    or FLAGS, #ASKS_DIRECT
    ret

; The host beats: it is not silent.
hear:
    andn FLAGS, #BEATS
    tst FLAGS, #SILENT
    jz be_patient
    andn FLAGS, #SILENT
    or FLAGS, #AGAIN
; The host falls silent so many ticks from now on.
be_patient:
    mov SILENT_AT, NEVER
    ld A, [TAKEN_SETUP + SILENCE_TICKS]
    cmp A, #0
    jz return
    cmp A[3], #0
    jnz return
    mov SILENT_AT, TICK
    add SILENT_AT, A
    ret

; Enables or disables the motor.
judge_enable:
    tst FLAGS, #ENABLE_ASKED
    jz disable
    tst FLAGS, #SILENT
    jz may_enable
    tst FLAGS, #DISABLES
    jnz disable
may_enable:
    tst FLAGS, #ENABLED
    jnz return
    or FLAGS, #ENABLED
    st TICK, [ENABLED_AT]
    or PIN_SETUP, #1
    enable PIN_SETUP
    ret
disable:
    tst FLAGS, #ENABLED
    jz return
    andn FLAGS, #ENABLED
    andn PIN_SETUP, #1
    enable PIN_SETUP
    cmp MOTION, #BODY
    jnc return
    mov REASON, #BY_HOST
    jmp end_run

; Begins a run that is new.
take_run:
    cmp REQUEST, #0
    jz return
    cmp REQUEST, RUN
    jz return
    mov RUN, REQUEST
    ld A, [TRIGGER]
    mov RUN_BITS, #0
    mov FRAME, #0
    mov MOTION, #WAITING
    mov TRIGGER_INPUTS, A
    mov OPENS, A[2]
    and OPENS, #1
    mov RUN_TAG, RUN
    mov I, #8
shift_run:
    add RUN_TAG, RUN_TAG
    sub I, #1
    jnz shift_run
    call restart_changes
    jmp judge_inputs

; Ends a run. `REASON`: a bit of STATUS, or 0.
end_run:
    or FLAGS, #AGAIN
    mov.3 LEFT, #0
    mov VELOCITY, #0
    tst SEEN, #INTO_LIMIT
    jz is_placed
    mov PHASE, #0
    mov PHASE[3], #0x8000
is_placed:
    or RUN_BITS, REASON
    or RUN_BITS, #FINISHED
    tst REASON, #BY_TRIGGER
    jz is_not_by_trigger
    mov TRIGGER_COUNT, COUNT
is_not_by_trigger:
    mov ENDED, MOTION
    mov MOTION, #REST
    call restart_changes
    call end_outputs
    cmp ENDED, #TAIL
    jz ends_in_tail
    cmp ENDED, #BODY
    jnz is_cut
    cmp REASON, #0
    jnz is_cut
    tst FLAGS, #IS_LAST
    jnz return
    jmp is_cut
ends_in_tail:
    or RUN_BITS, #IN_TAIL
is_cut:
    ld A, [TAKEN_SETUP + AT_CUT]
    jmp make_safe
