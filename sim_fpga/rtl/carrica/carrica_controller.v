// One motor that needs neither a timer nor a division: a step occurs when the clock periods since the last one, times
// the reference speed, reach one.
//
// Source: Carrica, Funes, Gonzalez, Fig. 5. A T_c has LAST + 1 clocks: 16 for the multiplication and two for the step.
// In the paper it has 32 of 40 MHz, 800 ns. Every step is in the same T_c as that of CarricaSteps
// (core/methods/carrica.hpp) with as many fraction bits; that file lists what the paper leaves open. The host computes
// the four numbers of a move.
module carrica_controller #(
    parameter FRACTION = 40,  // at least COUNT_BITS
    parameter STEP_BITS = 22,
    parameter COUNT_BITS = 16, // the slowest speed is a step in 2^COUNT_BITS - 1 periods
    parameter [4:0] LAST = 31 // 17 ... 31
) (
    input clk,
    input reset,
    input start,              // at rest: begins a move with these numbers, which must not change during it
    input [FRACTION:0] min,
    input [FRACTION:0] max,
    input [FRACTION:0] change, // not 0
    input [FRACTION+STEP_BITS+1:0] braking_at_max,
    input [STEP_BITS-1:0] steps, // at least one
    input backward,
    input half,               // half steps
    output reg moving,
    output reg period,        // for one clock in each T_c of a move, with its step
    output reg step,
    output [3:0] phases
);
    localparam DECIDE = COUNT_BITS + 1;
    reg [4:0] clock;          // of this T_c
    reg [STEP_BITS-1:0] remaining; // after the next step
    wire begins = start && !moving;
    wire first = moving && clock == 0;
    wire deciding = moving && clock == DECIDE;
    wire steps_now = deciding && reached;
    wire reached;
    wire [FRACTION:0] speed;

    reference_speed #(.FRACTION(FRACTION), .STEP_BITS(STEP_BITS)) reference (
        .clk(clk), .start(begins), .update(first), .min(min), .max(max), .change(change),
        .braking_at_max(braking_at_max), .decide(steps_now), .remaining(remaining), .speed(speed));
    comparator #(.FRACTION(FRACTION), .COUNT_BITS(COUNT_BITS)) compare (
        .clk(clk), .restart(begins || steps_now), .count(first), .speed(speed), .reached(reached));
    phase_driver driver (
        .clk(clk), .reset(reset), .step(step), .backward(backward), .half(half), .phases(phases));

    always @(posedge clk) begin
        period <= deciding;
        step <= steps_now && !reset;
        if (reset) moving <= 0;
        else if (begins) moving <= 1;
        else if (steps_now && remaining == 0) moving <= 0;
        clock <= begins || clock == LAST ? 0 : clock + 1'b1;
        if (begins) remaining <= steps - 1'b1;
        else if (steps_now) remaining <= remaining - 1'b1;
    end
endmodule
