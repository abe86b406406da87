// The registers of the location and of the destination, and two subtractors for the distance between them.
//
// Source: Lam and Ehkan, Section III.A and Fig. 2, the "concurrent logic". Two subtractors, so that the distance has no
// sign. Locations are pulses from the origin. Before the origin is known the location may be negative.
module lam_location #(
    parameter BITS = 16,
    parameter HOME = 50 // pulses from the origin to the predefined place
) (
    input clk,
    input origin,                // the head is at the origin, and its destination becomes HOME
    input take,                  // the destination counts from this clock on
    input pulse,
    input right,                 // the direction of the pulse
    input [BITS-1:0] destination,
    output reg [BITS-1:0] location,
    output [BITS-1:0] distance,  // of the destination, which may be taken in this clock
    output to_right
);
    reg [BITS-1:0] target;
    wire [BITS-1:0] wanted = take ? destination : target;
    wire [BITS:0] rightward = {wanted[BITS-1], wanted} - {location[BITS-1], location};
    wire [BITS-1:0] leftward = location - wanted;
    assign to_right = !rightward[BITS];
    assign distance = to_right ? rightward[BITS-1:0] : leftward;

    initial location = 0;
    always @(posedge clk) begin
        if (origin) target <= HOME;
        else target <= wanted;
        if (origin) location <= 0;
        else if (pulse) location <= right ? location + 1'b1 : location - 1'b1;
    end
endmodule
