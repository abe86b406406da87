; What the program knows of each motor. A register holds limbs of 16 bits; a word of the map is four limbs. The first
; registers are the words that the device shows, in the order of the map.

INPUTS = 8                      ; at most 15
DIGITAL = 8                     ; at most 16
ANALOG = 2                      ; at most 2
SEGMENT_ENTRIES = 256           ; of the rings, as in `entry`, `word` and `small_entry` of motors_core.v
CAPTURE_ENTRIES = 256
OUTPUT_ENTRIES = 32
EVENT_ENTRIES = 32
LONGEST_TIME = 94               ; of a pulse time
CLOCK_HZ = 48000000
TICK_CLOCKS = 1920
TICK_NS = TICK_CLOCKS * 10**9 // CLOCK_HZ
TIME_UNIT_PS = (8 * 10**12 + CLOCK_HZ // 2) // CLOCK_HZ
LEAD_TICKS = 290                ; one piece, or one change of an output, is checked in a tick
OWN_WIDTH = 12                  ; of a step, if the setup names none

; Memory of a motor: rings, the host's words, what is shown, and the device's own words. In limbs.
SEGMENTS = 0x0000
CAPTURES = 0x1000
CHANGES = 0x1400
EVENTS = 0x1600
HOST = 0x1800
ANALOG_TABLE = 0x1900
INPUT_TABLE = 0x1980
SHOWN = 0x1a00
DEBOUNCE = 0x1b00               ; of each input
SINCE = 0x1b40                  ; of each input: when its pin changed
VALUES = 0x1b80                 ; of analog outputs
SLOPES = 0x1ba0
TAKEN_SETUP = 0x1c00            ; the host's words from SETUP_REQUEST on, as they were taken
REFUSED = 0x1c80                ; the SETUP_REQUEST that was refused last
DIRECT_SEEN = 0x1c84            ; the DIRECT_REQUEST, the BEAT
BEAT_SEEN = 0x1c88
ENABLED_AT = 0x1c8c             ; the tick

; The host's words.
RUN_REQUEST = HOST
TRIGGER = HOST + 4
ARM = HOST + 8
VETOES = HOST + 12
STOP = HOST + 16
SEGMENT_HEAD = HOST + 20
CAPTURE_TAIL = HOST + 24
OUTPUT_HEAD = HOST + 28
EVENT_TAIL = HOST + 32
BEAT = HOST + 36
ENABLE = HOST + 40
DIRECT_REQUEST = HOST + 44
DIRECT_OUTPUTS = HOST + 48
SETUP_REQUEST = HOST + 128
STEP_WIDTH = 4                  ; behind SETUP_REQUEST
DIRECTION_SETUP = 8
DIRECTION_HOLD = 12
ENABLE_TICKS = 16
INVERTED = 20
INPUTS_INVERTED = 24
LIMIT_MIN = 28
LIMIT_MAX = 32
HOME = 36
STOP_INPUTS = 40
OUTPUTS_INVERTED = 44
AT_CUT = 48
AT_SILENCE = 52
SILENCE_TICKS = 56
COMPARE_OUTPUTS = 60

reg SEQUENCE 4 0
reg TICK 4 4
reg STATUS 4 8
reg COUNT 4 12
reg PHASE 4 16
reg VELOCITY 4 20
reg RUN 4 24
reg FRAME 4 28
reg TRIGGER_COUNT 4 32
reg ENCODER 4 36
reg SEGMENT_TAIL 4 40
reg CAPTURE_HEAD 4 44
reg CAPTURE_LOST 4 48
reg CAPTURE_SUM 4 52
reg CAPTURE_SUMS 4 56
reg SETUP 4 60
reg CLOSED 4 64                 ; INPUTS
reg LEVELS 4 68                 ; OUTPUTS
reg OUTPUT_TAIL 4 72
reg EVENT_HEAD 4 76
reg EVENT_LOST 4 80
reg PULSES_LEFT 4 84            ; always 0
reg ANALOG_LOWER 4 88
reg ANALOG_UPPER 4 92
reg ACCELERATION 4 96
reg LEFT 4 100                  ; ticks of the present piece, times 256, in three limbs
reg REQUEST 4 104               ; the host's words: RUN_REQUEST, ARMED, VETO
reg ARMED 4 108
reg VETO 4 112
reg SILENT_AT 4 116             ; the tick in which the host falls silent
reg NUMBER 4 120                ; of the next frame
reg TAG 4 124                   ; the header of the next frame
reg START 4 128
reg COUNTS 4 132
reg FRAME_PHASE 4 136
reg BASE 4 140                  ; the tick from which on changes of outputs are counted
reg NEXT_DUE 4 144              ; the tick of the next change, 0 if it is to be found
reg LAST_IN_BODY 4 148          ; of the next frame's changes
reg LAST_IN_TAIL 4 152
reg EVENT 4 156                 ; WHAT
reg EVENT_VALUE 4 160
reg EVENT_DETAIL 4 164
reg VALUE 4 168                 ; of an analog output
reg SLOPE 4 172
reg A 4 176                     ; for a while
reg B 4 180
reg C 4 184
reg NEVER 4 240                 ; the last tick
reg RUN_TAG 2 188               ; the run as in a TAG
reg TRIGGER_INPUTS 2 190
reg FLAGS 1 192
reg MOTION 1 193
reg SEEN 1 194                  ; of the inputs
reg RUN_BITS 1 195              ; of STATUS
reg REASON 1 196                ; why the run ends
reg SEGMENTS_IN 1 197           ; low limbs of the host's heads and tails
reg CAPTURES_OUT 1 198
reg CHANGES_IN 1 199
reg EVENTS_OUT 1 200
reg TAKEN 1 201                 ; entries taken off the segment ring: where the next frame is
reg LOADED 1 202                ; entries behind
reg SCAN 1 203                  ; what is known of the next frame
reg CHECKED 1 204               ; pieces of it
reg PIECES 1 205
reg PIECE 1 206                 ; the present one in the ring
reg BODY_LEFT 1 207
reg TAIL_LEFT 1 208
reg FRAME_BEGIN 1 209
reg CHECKS 1 210                ; how many more a decision waits for
reg DROPS 1 211                 ; which frames are taken off the ring
reg MAY 1 212                   ; the next frame may begin
reg CHANGE 1 213                ; the entry of the output ring that is looked at
reg CHANGE_SCAN 1 214
reg CHANGE_FIRST 1 215          ; the first one of the next frame
reg FIRST 1 216                 ; of the present frame, and that behind its last one
reg BEHIND 1 217
reg DUE 1 218                   ; the entry that is due next
reg DUE_TAG 1 219               ; low limb of its TAG
reg HAS_SLOPE 1 220             ; by analog outputs
reg IS_ZERO 1 221
reg CHANNEL 1 222
reg CHANNEL_BIT 1 223
reg CHANNEL_HIGH 1 224          ; times 256
reg NEW_LEVELS 1 225
reg NEW_MASK 1 226
reg SAFE_ANALOG 1 227
reg EXPECTED 1 228              ; the pins if nothing changes; its highest bit is set while a debounce runs
reg INVERTS 1 229               ; INPUTS_INVERTED
reg PENDING 1 230
reg DIFFERENT 1 231
reg CHANGED 1 232
reg BIT 1 233
reg I 1 234
reg X 1 235
reg Y 1 236
reg PIN_SETUP 1 237             ; INVERTED and the enable, as the pins have it
reg ENDED 1 244                 ; MOTION before the run ended
reg OPENS 1 238                 ; of TRIGGER
reg OUTPUT_PINS_INVERTED 1 239

; FLAGS
NEW_SETUP = 0x0001
STOP_ASKED = 0x0002
LOST = 0x0004
AGAIN = 0x0008                  ; orders are looked at once more in the next tick
SILENT = 0x0010
DISABLES = 0x0020               ; silence does
IS_SET_UP = 0x0040
ENABLED = 0x0080
ENABLE_ASKED = 0x0100
FORWARD = 0x0200                ; a step in this tick
BACKWARD = 0x0400
ASKS_DIRECT = 0x0800
BEATS = 0x1000
BAD_SETUP = 0x2000
IS_LAST = 0x4000                ; the present frame
USABLE = 0x8000                 ; its outputs

; MOTION
REST = 0
WAITING = 1
BODY = 2
TAIL = 3

; SEEN, the first three as in STATUS
AT_MIN = 0x0008
AT_MAX = 0x0010
AT_HOME = 0x0020
STOPPED = 0x0040
TRIGGERED = 0x0080
INTO_LIMIT = 0x0100
FELL_SILENT = 0x0200

; RUN_BITS and REASON, as in STATUS
FINISHED = 0x0002
IN_TAIL = 0x0004
BY_LIMIT = 0x0040
BY_TRIGGER = 0x0080
BY_HOST = 0x0100
BAD_SEGMENT = 0x0200
OVERFLOWS = 0x0400
BY_INPUT = 0x2000
BAD_OUTPUT = 0x8000

; SCAN
FOUND = 1                       ; its header was read
BAD = 2                         ; it cannot be run
VALID = 4                       ; there is a frame
OF_RUN = 8
GOOD = 16                       ; all of it was checked, and all of its changes
KNOWN = 32                      ; its pieces were

; DROPS
OWN = 1
OTHERS = 2

; CHANGE_SCAN
CHANGES_FOUND = 1
CHANGES_BAD = 2
CHANGES_END = 4                 ; the next entry is of a later frame
