// The memory of all motors: their rings and the host's words. It does one thing in each clock: the core has it when it
// needs it, the host else.
module motors_memory #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3
) (
    input clk,
    input write,
    // verilator lint_off UNUSED
    input [MOTOR_BITS+12:0] address,
    // verilator lint_on UNUSED
    input [15:0] data,
    output reg [15:0] word      // two clocks after the address
);
    (* no_rw_check *) reg [15:0] words[0:(MOTORS << 13)-1];
    reg [15:0] found;
    always @(posedge clk) begin
        if (write) words[address] <= data;
        else found <= words[address];
    end
    always @(posedge clk) word <= found;
endmodule
