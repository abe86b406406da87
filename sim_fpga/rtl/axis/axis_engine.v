// The step engine of one motor: velocity += acceleration and phase += velocity at each tick. It is
// core/step/tick_engine.hpp in registers: `phase` is position + 1/2 step modulo one step, a step forward is the carry
// of phase + velocity, a step backward its borrow. A tick takes two clocks, one for each addition.
module axis_engine (
    input clk,
    input [63:0] word,          // of a piece in the segment ring
    input load_ticks,           // takes the word as the piece's TAG
    input load_velocity,        // half a tick before the piece, signed
    input load_acceleration,
    input accelerate,           // first clock of a tick
    input travel,               // second clock of a tick
    input halt,                 // drops the rest of the piece
    input rebase,               // at rest: takes this phase
    input [63:0] rebase_phase,
    output reg [63:0] phase,
    output [63:0] velocity,     // 0 at rest
    output idle,                // there is no piece, or it has ended
    output reg overflow,        // after `accelerate`: the velocity left 64 bits
    output reg step,            // for the clock after `travel`: the tick makes a step
    output backward             // its direction
);
    reg [63:0] speed, acceleration;
    reg [31:0] left;            // ticks of the present piece
    wire [63:0] faster = speed + acceleration;
    wire [64:0] further = {1'b0, phase} + {1'b0, speed};
    wire is_same_sign = speed[63] == acceleration[63];
    assign idle = left == 0;
    assign velocity = idle ? 64'd0 : speed;
    assign backward = speed[63];

    initial begin
        phase = 64'h8000000000000000;
        speed = 0;
        acceleration = 0;
        left = 0;
        overflow = 0;
        step = 0;
    end
    always @(posedge clk) begin
        if (load_velocity) speed <= word;
        else if (accelerate) speed <= faster;
        if (load_acceleration) acceleration <= word;
        if (accelerate) overflow <= is_same_sign && faster[63] != speed[63];
        step <= travel && further[64] != backward;
        if (rebase) phase <= rebase_phase;
        else if (travel) phase <= further[63:0];
        if (halt) left <= 0;
        else if (load_ticks) left <= word[39:8];
        else if (travel) left <= left - 1'b1;
    end
endmodule
