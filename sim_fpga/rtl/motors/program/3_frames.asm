; What begins: a run's first frame, the next piece, the next frame, or the tail.
decide:
    mov CHECKS, checks
    cmp MOTION, #BODY
    jc piece_ends
    tst MOTION, #WAITING
    jnz wait
    call take_run
    tst MOTION, #WAITING
    jnz wait
    mov DROPS, #OWN
    call settle_frames
    jmp settle_changes

; The first frame: at its start, or it came too late.
wait:
    mov DROPS, #OTHERS
    call settle_frames
    call settle_changes
    tst SCAN, #VALID
    jz return
    mov NUMBER, #1
    cmp NUMBER, VETO
    jc is_vetoed
    cmp TICK, START
    jless return
    call judge_frame
    tst MAY, #1
    jz return
    cmp.2 TAG[2], NUMBER
    jnz is_bad
    cmp START, TICK
    jnz is_bad
    cmp.2 COUNTS, COUNT
    jnz is_bad
    cmp FRAME_PHASE, PHASE
    jz is_same_place
    mov A, FRAME_PHASE              ; at a whole step: 1/2, or just below
    mov X, A[3]
    cmp X, #0x8000
    jc is_upper
    add A, #1
is_upper:
    mov B, #0
    mov B[3], #0x8000
    cmp A, B
    jnz is_bad
is_same_place:
    mov PHASE, FRAME_PHASE
    tst SCAN, #GOOD
    jz is_bad
    call take_frame
    mov REASON, #BY_INPUT
    tst SEEN, #STOPPED
    jnz end_run
    mov REASON, #BY_TRIGGER
    tst SEEN, #TRIGGERED
    jnz end_run
    jmp begin_frame
is_vetoed:
    mov REASON, #0
    jmp end_run
is_bad:
    mov REASON, #BAD_SEGMENT
    jmp end_run

; The end of a piece.
piece_ends:
    tst MOTION, #1
    jnz tail_piece_ends
    sub BODY_LEFT, #1
    jnz next_piece
    tst FLAGS, #IS_LAST
    jnz is_vetoed
    call settle_frames
    call settle_changes
    tst SCAN, #VALID
    jz begin_tail
    tst SCAN, #OF_RUN
    jz begin_tail
    mov NUMBER, FRAME
    add NUMBER, #1
    cmp.2 TAG[2], NUMBER
    jnz begin_tail
    call judge_frame
    tst MAY, #1
    jz begin_tail
    tst SCAN, #GOOD
    jz bad_frame
    cmp START, TICK
    jnz bad_frame
    cmp.2 COUNTS, COUNT
    jnz bad_frame
    cmp FRAME_PHASE, PHASE
    jz follow
bad_frame:
    or RUN_BITS, #BAD_SEGMENT
begin_tail:
    mov REASON, #0
    cmp TAIL_LEFT, #0
    jz end_run
    mov MOTION, #TAIL
    mov DUE_TAG, RUN_TAG[0]
    or DUE_TAG, #1
    call begin_changes
next_piece:
    add PIECE, #1
    jmp load_piece
tail_piece_ends:
    mov REASON, #0
    sub TAIL_LEFT, #1
    jz end_run
    jmp next_piece

; Takes the next frame off the ring.
take_frame:
    mov DROPS, #0
    mov FRAME_BEGIN, TAKEN
    mov PIECE, TAKEN
    add TAKEN, PIECES
    add PIECE, #1
    add TAKEN, #1
    mov SCAN, #0
    ret
follow:
    call take_frame
begin_frame:
    mov MOTION, #BODY
    mov FRAME, NUMBER
    mov BODY_LEFT, COUNTS[2]
    mov TAIL_LEFT, COUNTS[3]
    andn FLAGS, #IS_LAST
    tst TAG[0], #2
    jz is_not_last
    or FLAGS, #IS_LAST
is_not_last:
    call take_changes
    mov DUE_TAG, RUN_TAG[0]
    call begin_changes
load_piece:
    entry PIECE
    ld A, [p+SEGMENTS]
    ld VELOCITY, [p+SEGMENTS + 4]
    ld ACCELERATION, [p+SEGMENTS + 8]
    and A[0], #0xff00
    mov.3 LEFT, A
    ret

; Whether the host and the motor let frame NUMBER begin.
judge_frame:
    mov MAY, #0
    cmp NUMBER, VETO
    jc return
    cmp ARMED, NUMBER
    jnc return
    cmp REQUEST, RUN
    jnz return
    mov X, FLAGS
    and X, #LOST | IS_SET_UP | ENABLED
    cmp X, #IS_SET_UP | ENABLED
    jnz return
    ld A, [ENABLED_AT]
    ld B, [TAKEN_SETUP + ENABLE_TICKS]
    mov C, TICK
    sub C, A
    cmp C, B
    jnc return
    mov MAY, #1
    ret

; Finds the next frame and checks all of it. Takes the frames that DROPS names off the ring.
settle_frames:
    andn SCAN, #VALID | OF_RUN | GOOD
    mov LOADED, SEGMENTS_IN
    sub LOADED, TAKEN
    jz return
    cmp LOADED, #SEGMENT_ENTRIES + 1
    jc return
    tst SCAN, #FOUND
    jnz is_found
    call read_header
is_found:
    or SCAN, #VALID
    tst TAG[0], #1
    jz is_other
    mov X, TAG[0]
    and X, #0xff00
    cmp X, RUN_TAG[0]
    jnz is_other
    cmp TAG[1], RUN_TAG[1]
    jnz is_other
    tst DROPS, #OWN
    jnz drop
    or SCAN, #OF_RUN
check_pieces:
    tst SCAN, #BAD
    jnz return
    cmp PIECES, LOADED
    jc return
    cmp CHECKED, PIECES
    jz is_good
    sub CHECKS, #1
    jnc return
    call check_piece
    jmp check_pieces
is_good:
    or SCAN, #GOOD | KNOWN
    ret
is_other:
    tst DROPS, #OTHERS
    jz check_pieces
drop:
    mov SCAN, #0
    tst TAG[0], #1
    jz drop_one
    cmp PIECES, LOADED
    jc drop_all
    add TAKEN, PIECES
drop_one:
    add TAKEN, #1
    jmp settle_frames
drop_all:
    mov TAKEN, SEGMENTS_IN
    jmp settle_frames

read_header:
    entry TAKEN
    ld TAG, [p+SEGMENTS]
    ld START, [p+SEGMENTS + 4]
    ld COUNTS, [p+SEGMENTS + 8]
    ld FRAME_PHASE, [p+SEGMENTS + 12]
    mov SCAN, #FOUND
    mov CHECKED, #0
    mov PIECES, COUNTS[2]
    add PIECES, COUNTS[3]
    jc too_many
    cmp COUNTS[2], #0
    jnz return
    or SCAN, #BAD
    ret
too_many:
    mov PIECES, #0xffff
    or SCAN, #BAD
    ret

check_piece:
    add CHECKED, #1
    mov X, TAKEN
    add X, CHECKED
    entry X
    ld A, [p+SEGMENTS]
    tst A[0], #1
    jnz piece_is_bad
    cmp A[3], #0
    jnz piece_is_bad
    tst A[2], #0xff00
    jnz piece_is_bad
    and A[0], #0xff00
    cmp.3 A, #0
    jnz return
piece_is_bad:
    or SCAN, #BAD
    ret
