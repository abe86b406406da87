// The whole part of a square root, up to a limit: counts how many odd numbers 1, 3, 5 ... can be subtracted.
//
// Lai, Chien, Tsao need it twice: for V_max of a short move, Eq. (10), and for the second compensation, Eq. (17). It
// takes a clock for each unit of the result. core/methods/lai_planner.cpp has whole_root().
module whole_root (
    input clk,
    input start,
    input [15:0] value,
    input [7:0] limit,        // the result is not greater
    output ready,             // from the second clock after `start` on
    output reg [7:0] root
);
    reg [15:0] rest;
    reg [7:0] left;           // of the limit
    wire [8:0] odd = {root, 1'b1};
    assign ready = left == 0 || rest < {7'd0, odd};
    always @(posedge clk) begin
        if (start) begin
            root <= 0;
            rest <= value;
            left <= limit;
        end else if (!ready) begin
            root <= root + 1'b1;
            rest <= rest - {7'd0, odd};
            left <= left - 1'b1;
        end
    end
endmodule
