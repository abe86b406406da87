; Shows the words of the map, all of one state.
show_words:
    add SEQUENCE, #2
    mov STATUS[0], RUN_BITS
    mov X, SEEN
    and X, #AT_MIN | AT_MAX | AT_HOME
    or STATUS[0], X
    mov STATUS[1], #0
    tst FLAGS, #LOST
    jz has_all_ticks
    mov STATUS[1], #1
has_all_ticks:
    tst FLAGS, #ENABLED
    jz is_disabled
    or STATUS[0], #0x0800
is_disabled:
    tst FLAGS, #SILENT
    jz is_heard
    or STATUS[0], #0x1000
is_heard:
    tst FLAGS, #BAD_SETUP
    jz is_well_set_up
    or STATUS[0], #0x4000
is_well_set_up:
    mov X, TAKEN                    ; the tails: entries of a frame in motion stay
    mov Y, BEHIND
    cmp MOTION, #BODY
    jnc show_tails
    mov X, FRAME_BEGIN
    mov Y, FIRST
    or STATUS[0], #1
    tst MOTION, #1
    jz show_tails
    or STATUS[0], #IN_TAIL
show_tails:
    sub X, SEGMENT_TAIL[0]
    sub Y, OUTPUT_TAIL[0]
    mov A, #0
    mov B, #0
    mov A[0], X
    mov B[0], Y
    add SEGMENT_TAIL, A
    add OUTPUT_TAIL, B
    ld A, [VALUES]
    ld B, [VALUES + 4]
    add.2 A[2], A[2]
    add.2 B[2], B[2]
    mov ANALOG_LOWER[0], A[3]
    mov ANALOG_LOWER[1], B[3]
    mov ENCODER, COUNT
    show SEQUENCE, [SHOWN]
    ret
