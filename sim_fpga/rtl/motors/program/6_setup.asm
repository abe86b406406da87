; Takes the setup, whole or not at all. It is load_setup and lack_of of the C++ (sim_fpga/channel_words.hpp,
; core/hardware/device_abilities.hpp).
take_setup:
    andn FLAGS, #NEW_SETUP
    ld A, [SETUP_REQUEST + STEP_WIDTH]
    cmp A, #LONGEST_TIME + 1
    jc refuse
    ld A, [SETUP_REQUEST + DIRECTION_SETUP]
    cmp A, #LONGEST_TIME + 1
    jc refuse
    ld A, [SETUP_REQUEST + DIRECTION_HOLD]
    cmp A, #LONGEST_TIME + 1
    jc refuse
    ld.2 A, [SETUP_REQUEST + INPUTS_INVERTED]
    ld.2 B, [SETUP_REQUEST + LIMIT_MIN]
    or.2 A, B
    ld.2 B, [SETUP_REQUEST + LIMIT_MAX]
    or.2 A, B
    ld.2 B, [SETUP_REQUEST + HOME]
    or.2 A, B
    ld.2 B, [SETUP_REQUEST + STOP_INPUTS]
    or.2 A, B
    and A[0], #0xffff & ~((1 << INPUTS) - 1)
    cmp.2 A, #0
    jnz refuse
    ld A, [SETUP_REQUEST + AT_CUT]
    ld B, [SETUP_REQUEST + AT_SILENCE]
    or A, B
    ld X, [SETUP_REQUEST + OUTPUTS_INVERTED]
    or A[1], X
    tst A[1], #0xffff & ~((1 << DIGITAL) - 1)
    jnz refuse
    tst A[2], #0xff & ~((1 << ANALOG) - 1)
    jnz refuse
    ld X, [SETUP_REQUEST + COMPARE_OUTPUTS]
    cmp X, #0
    jnz refuse
    mov I, #INPUTS                  ; no debounce of inputs that are not there, and no PWM
check_debounce:
    word I
    ld A, [p+INPUT_TABLE]
    cmp A, #0
    jnz refuse
    add I, #1
    cmp I, #32
    jnz check_debounce
    mov I, #0
check_pwm:
    word I
    ld A, [p+ANALOG_TABLE]
    cmp A, #0
    jnz refuse
    add I, #2
    cmp I, #16
    jnz check_pwm

    or FLAGS, #IS_SET_UP
    ld SETUP, [SETUP_REQUEST]
    mov I, #1                       ; a copy of the words
copy_setup:
    word I
    ld A, [p+SETUP_REQUEST]
    st A, [p+TAKEN_SETUP]
    add I, #1
    cmp I, #15
    jnz copy_setup
    mov I, #0
copy_debounce:
    word I
    ld A, [p+INPUT_TABLE]
    st A, [p+DEBOUNCE]
    add I, #1
    cmp I, #INPUTS
    jnz copy_debounce

    ld A, [TAKEN_SETUP + AT_SILENCE]
    andn FLAGS, #DISABLES | SILENT
    tst A[2], #0x100
    jz keeps_enabled
    or FLAGS, #DISABLES
keeps_enabled:
    call be_patient
    ld OUTPUT_PINS_INVERTED, [TAKEN_SETUP + OUTPUTS_INVERTED]
    call show_levels
    ld X, [TAKEN_SETUP + INVERTED]  ; the motor's pins
    and X, #7
    add X, X
    and PIN_SETUP, #1
    or PIN_SETUP, X
    enable PIN_SETUP
    ld X, [TAKEN_SETUP + STEP_WIDTH]
    cmp X, #0
    jnz has_width
    mov X, #OWN_WIDTH
has_width:
    ld Y, [TAKEN_SETUP + DIRECTION_SETUP]
    add X, Y
    mov I, #8
shift_end:
    add X, X
    sub I, #1
    jnz shift_end
    or X, Y
    times X
    ld X, [TAKEN_SETUP + INPUTS_INVERTED]
    mov CHANGED, INVERTS
    xor CHANGED, X
    mov INVERTS, X
    xor CLOSED[0], CHANGED
    jmp note_inputs

refuse:
    or FLAGS, #BAD_SETUP
    ld A, [SETUP_REQUEST]
    st A, [REFUSED]
    ret
