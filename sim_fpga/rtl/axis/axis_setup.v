// Takes the setup from the host's words: reads all of them and checks that the device can do what they say, then reads
// them again into registers. So a setup is taken whole or not at all. It is load_setup and lack_of of the C++
// (sim_fpga/channel_words.hpp, core/hardware/device_abilities.hpp). Times in ticks that need more than 32 bits become
// the longest.
module axis_setup #(
    parameter INPUTS = 8,
    parameter DIGITAL = 8,
    parameter ANALOG = 2,
    parameter TIME_BITS = 16    // of a pulse time
) (
    input clk,
    input start,                // for one clock
    output busy,                // reading, from the clock after `start` on
    output taken,               // for the last clock: the setup is that of the host's words
    output refused,             // for the last clock: the device cannot do it, and its setup is as before
    output reads,
    output [6:0] address,       // in axis_host_memory.v; at rest that of SETUP_REQUEST
    input [63:0] word,
    output reg [TIME_BITS-1:0] step_width,
    output reg [TIME_BITS-1:0] direction_setup,
    output reg [TIME_BITS-1:0] direction_hold,
    output reg [31:0] enable_ticks,
    output reg [2:0] inverted,
    output reg [INPUTS-1:0] inputs_inverted,
    output invert_inputs,       // for one clock, in which inputs_inverted becomes next_inputs_inverted
    output [INPUTS-1:0] next_inputs_inverted,
    output reg [INPUTS-1:0] limit_min,
    output reg [INPUTS-1:0] limit_max,
    output reg [INPUTS-1:0] home,
    output reg [INPUTS-1:0] stop,
    output set_debounce,        // for one clock: of this input
    output [4:0] debounce_input,
    output [31:0] debounce_ticks,
    output reg [ANALOG*TIME_BITS-1:0] pwm_periods,
    output reg [15:0] outputs_inverted,
    output reg [39:0] at_cut,
    output reg [39:0] at_silence,
    output reg disables_at_silence,
    output reg [31:0] silence_ticks
);
    // The words in the order in which they are read.
    localparam STEP_WIDTH = 0, DIRECTION_SETUP = 1, DIRECTION_HOLD = 2, ENABLE_TICKS = 3, INVERTED = 4,
        INPUTS_INVERTED = 5, LIMIT_MIN = 6, LIMIT_MAX = 7, HOME = 8, STOP = 9, OUTPUTS_INVERTED = 10, AT_CUT = 11,
        AT_SILENCE = 12, SILENCE_TICKS = 13, COMPARE_OUTPUTS = 14, DEBOUNCE = 16, PWM_PERIOD = 48, LAST = 55;
    localparam [5:0] REQUEST = 32, FIRST_WORD = 33, INPUT_TABLE = 32; // in axis_host_memory.v
    localparam REST = 0, CHECK = 1, TAKE = 2;
    reg [1:0] state;
    reg [5:0] at;
    reg asked;                  // the memory shows the word
    wire is_debounce = at >= DEBOUNCE && at < PWM_PERIOD;
    wire [4:0] channel = at[4:0] - DEBOUNCE[4:0];
    wire [6:0] pwm_word = {1'b1, 2'd0, at[2:0], 1'b0};
    assign address = state == REST ? {1'b0, REQUEST} : at < DEBOUNCE ? {1'b0, FIRST_WORD + at} :
        is_debounce ? {1'b1, INPUT_TABLE + {1'b0, channel}} : pwm_word;

    reg is_possible;
    always @* case (at)
        STEP_WIDTH, DIRECTION_SETUP, DIRECTION_HOLD: is_possible = word >> TIME_BITS == 0;
        INPUTS_INVERTED, LIMIT_MIN, LIMIT_MAX, HOME, STOP: is_possible = word[31:0] >> INPUTS == 0;
        OUTPUTS_INVERTED: is_possible = word[15:0] >> DIGITAL == 0;
        COMPARE_OUTPUTS: is_possible = word[15:0] == 0;
        AT_CUT, AT_SILENCE: is_possible = word[31:16] >> DIGITAL == 0 && word[39:32] >> ANALOG == 0;
        default: is_possible = at < DEBOUNCE || word == 0 || (is_debounce ? {27'd0, channel} < INPUTS :
            {29'd0, at[2:0]} < ANALOG && word >> TIME_BITS == 0);
    endcase

    wire is_read = state == TAKE && asked;
    wire is_last = at == LAST && asked;
    wire [31:0] ticks = word[63:32] != 0 ? 32'hffffffff : word[31:0];
    assign busy = state != REST;
    assign reads = busy && !asked;
    assign taken = state == TAKE && is_last;
    assign refused = state == CHECK && asked && !is_possible;
    assign set_debounce = is_read && is_debounce;
    assign debounce_input = channel;
    assign debounce_ticks = ticks;
    assign invert_inputs = is_read && at == INPUTS_INVERTED;
    assign next_inputs_inverted = word[INPUTS-1:0];

    initial begin
        {state, at, asked, step_width, direction_setup, direction_hold, enable_ticks, inverted, inputs_inverted} = 0;
        {limit_min, limit_max, home, stop, outputs_inverted, at_cut, at_silence, disables_at_silence} = 0;
        {silence_ticks, pwm_periods} = 0;
        limit_min[0] = 1;
        limit_max[1] = 1;
        home[2] = 1;
    end
    always @(posedge clk) begin
        asked <= busy && !asked;
        if (start) begin
            state <= CHECK;
            at <= 0;
        end else if (asked) begin
            at <= is_last ? 6'd0 : at + 1'b1;
            if (refused || taken) state <= REST;
            else if (is_last) state <= TAKE;
        end
        if (is_read && at >= PWM_PERIOD && {29'd0, at[2:0]} < ANALOG)
            pwm_periods[TIME_BITS*at[2:0] +: TIME_BITS] <= word[TIME_BITS-1:0];
        if (is_read) case (at)
            STEP_WIDTH: step_width <= word[TIME_BITS-1:0];
            DIRECTION_SETUP: direction_setup <= word[TIME_BITS-1:0];
            DIRECTION_HOLD: direction_hold <= word[TIME_BITS-1:0];
            ENABLE_TICKS: enable_ticks <= ticks;
            INVERTED: inverted <= word[2:0];
            INPUTS_INVERTED: inputs_inverted <= next_inputs_inverted;
            LIMIT_MIN: limit_min <= word[INPUTS-1:0];
            LIMIT_MAX: limit_max <= word[INPUTS-1:0];
            HOME: home <= word[INPUTS-1:0];
            STOP: stop <= word[INPUTS-1:0];
            OUTPUTS_INVERTED: outputs_inverted <= word[15:0];
            AT_CUT: at_cut <= word[39:0];
            AT_SILENCE: {disables_at_silence, at_silence} <= word[40:0];
            SILENCE_TICKS: silence_ticks <= ticks;
            default: ;
        endcase
    end
endmodule
