// The add-only engine of one axis: each tick adds the acceleration to the speed and the speed to the position, and
// makes a step when the position has grown by one.
//
// Source: P. Ranade, "Linear motor control without the math", the cumulative addition after Table 1; a tick is 1 us
// there, 20 clocks of 20 MHz. It is core/step/tick_engine.hpp in registers: `phase` is position + 1/2 step modulo one
// step, a step forward is the carry of phase + velocity, a step backward its borrow. add_only_engine.v makes the same
// steps for many motors.
module add_only_axis #(
    parameter BITS = 64,       // of a fraction of a step
    parameter TICK_BITS = 32
) (
    input clk,
    input reset,               // at rest on a whole step
    input tick,                // for one clock of at least two
    input next_valid,          // the next piece begins when the present one has ended
    input [TICK_BITS-1:0] next_ticks, // at least one
    input [BITS-1:0] next_velocity, // half a tick before the piece, signed
    input [BITS-1:0] next_acceleration, // signed
    output next_taken,         // in the clock in which it begins
    output reg step,           // in the clock after the tick
    output reg backward,       // the direction
    output [BITS-1:0] phase_out,
    output [BITS-1:0] velocity_out
);
    reg [BITS-1:0] phase, velocity, acceleration;
    reg [TICK_BITS-1:0] left;  // ticks of the present piece
    wire moving = left != 0;
    assign next_taken = next_valid && !moving && !tick && !reset;
    assign phase_out = phase;
    assign velocity_out = velocity;

    wire [BITS-1:0] faster = velocity + acceleration;
    wire [BITS:0] further = {1'b0, phase} + {1'b0, faster};
    wire carry = further[BITS];
    wire negative = faster[BITS-1];

    always @(posedge clk) begin
        step <= tick && moving && !reset && carry != negative;
        backward <= negative;
        if (reset) begin
            left <= 0;
            phase <= {1'b1, {(BITS - 1){1'b0}}};
        end else if (tick && moving) begin
            velocity <= faster;
            phase <= further[BITS-1:0];
            left <= left - 1'b1;
        end else if (next_taken) begin
            velocity <= next_velocity;
            acceleration <= next_acceleration;
            left <= next_ticks;
        end
    end
endmodule
