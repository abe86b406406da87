// The reference speed: a trapezoid over time, and the distance that braking from it needs, by additions alone.
//
// Source: Carrica, Funes, Gonzalez, "Novel stepper motor controller based on FPGA hardware implementation", Fig. 4.
// Each T_c the speed changes by `change`. Speeds are in 2^-FRACTION step per T_c.
//   braking    (V^2 - V_min^2)/change, twice the way to V_min, in 2^-FRACTION step. When V becomes V' = V +- change
//              it changes by +-(V + V'). So it stays exact without a multiplication. Only where the last change to
//              V_max is smaller the host's value counts.
module reference_speed #(
    parameter FRACTION = 40,
    parameter STEP_BITS = 22
) (
    input clk,
    input start,              // the speed is V_min, and rises
    input update,             // once each T_c
    input [FRACTION:0] min,
    input [FRACTION:0] max,
    input [FRACTION:0] change,
    input [FRACTION+STEP_BITS+1:0] braking_at_max, // (max^2 - min^2)/change, rounded down
    input decide,             // after a step
    input [STEP_BITS-1:0] remaining, // steps after this one
    output reg [FRACTION:0] speed
);
    localparam RISING = 0, LEVEL = 1, FALLING = 2;
    reg [1:0] slope;
    reg [FRACTION+STEP_BITS+1:0] braking;
    wire falling = slope == FALLING;
    wire too_fast = {1'b0, remaining} <= braking[FRACTION+STEP_BITS+1:FRACTION+1];

    // An adder serves both directions: x - y is x + ~y + 1.
    wire [FRACTION+2:0] next =
        {2'b0, speed} + ({2'b0, change} ^ {(FRACTION + 3){falling}}) + {{(FRACTION + 2){1'b0}}, falling};
    wire [FRACTION:0] bound = falling ? min : max;
    // verilator lint_off UNUSEDSIGNAL
    wire [FRACTION+2:0] beyond = next - {2'b0, bound}; // its sign counts
    // verilator lint_on UNUSEDSIGNAL
    wire at_bound = beyond[FRACTION+2] == falling;
    wire [FRACTION+STEP_BITS+1:0] gained = {{STEP_BITS{1'b0}}, {1'b0, speed} + next[FRACTION+1:0]};
    wire [FRACTION+STEP_BITS+1:0] next_braking =
        braking + (gained ^ {(FRACTION + STEP_BITS + 2){falling}}) + {{(FRACTION + STEP_BITS + 1){1'b0}}, falling};

    always @(posedge clk) begin
        if (start) begin
            speed <= min;
            braking <= 0;
            slope <= RISING;
        end else if (update && slope != LEVEL) begin
            speed <= at_bound ? bound : next[FRACTION:0];
            braking <= !at_bound ? next_braking : falling ? 0 : braking_at_max;
        end
        if (decide && !start) begin
            if (too_fast) slope <= FALLING;
            else if (falling) slope <= LEVEL;
        end
    end
endmodule
