// The four phases of a stepper motor: each step turns the field by 90 degrees in full steps, by 45 in half steps.
//
// Sources: D. Carrica, M. A. Funes, S. A. Gonzalez, "Novel stepper motor controller based on FPGA hardware
// implementation", Fig. 5, the DRIVER INTERFACE; C.-K. Lai, W.-N. Chien, Y.-T. Tsao, "An FPGA-Based Multiple-Axis
// Velocity Controller and Stepping Motors Drives Design", Fig. 12, Step0Out[3:0]. Phase i pulls towards i * 90 degrees.
// In full steps two phases are on, so the torque is the same in every position.
module phase_driver (
    input clk,
    input reset,
    input step,
    input backward,
    input half,               // half steps; changes at rest
    output reg [3:0] phases
);
    reg [2:0] eighth;         // the direction of the field is eighth * 45 degrees; odd in full steps
    wire [2:0] turn = half ? 3'd1 : 3'd2;
    always @(posedge clk) begin
        if (reset) eighth <= 1;
        else if (step) eighth <= backward ? eighth - turn : eighth + turn;
    end

    always @* case (eighth)
        0: phases = 4'b0001;
        1: phases = 4'b0011;
        2: phases = 4'b0010;
        3: phases = 4'b0110;
        4: phases = 4'b0100;
        5: phases = 4'b1100;
        6: phases = 4'b1000;
        default: phases = 4'b1001;
    endcase
endmodule
