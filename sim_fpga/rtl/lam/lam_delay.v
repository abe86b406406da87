// The delay counter: how many clocks each wait between two pulses lasts.
//
// Source: Lam C. Y. and P. Ehkan, "Design and Implementation of FPGA Based Bipolar Stepper Motor Controller for Linear
// Slide Application", Section III.C, Eqs. (1) and (2). core/methods/lam_controller.hpp is the same in C++.
module lam_delay #(
    parameter BITS = 8,
    parameter START = 100,
    parameter CRUISE = 6,
    parameter ACCELERATION = 2,  // counts fewer each pulse, Eq. (1)
    parameter DECELERATION = 10, // counts more each pulse, Eq. (2)
    parameter STOP = 44
) (
    input clk,
    input restart,    // the wait begins again, with START
    input count,      // one clock of the wait passes
    input accelerate, // at the pulse: the next wait is shorter
    input decelerate, // at the pulse: the next wait is longer, unless it is STOP or more
    output due,       // this clock is the last one of the wait, if it counts
    output cruising,  // the next wait is CRUISE
    output reg [BITS-1:0] delay
);
    reg [BITS-1:0] left;
    assign due = left == 1;

    wire [BITS-1:0] shorter = delay < CRUISE + ACCELERATION ? CRUISE : delay - ACCELERATION;
    wire [BITS-1:0] longer = delay < STOP ? delay + DECELERATION : delay;
    wire [BITS-1:0] next = decelerate ? longer : accelerate ? shorter : delay;
    assign cruising = shorter == CRUISE;

    always @(posedge clk) begin
        if (restart) begin
            delay <= START;
            left <= START;
        end else if (count) begin
            if (due) delay <= next;
            left <= due ? next : left - 1'b1;
        end
    end
endmodule
