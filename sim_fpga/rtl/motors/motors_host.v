// The host's side of the memory: the map of REGISTERS.md for each motor.
//
// Rings can be written at any time. Other words are written between two ticks, so that no tick sees a half of one, and
// all motors see them from the same tick on.
module motors_host #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3
) (
    input clk,
    // verilator lint_off UNUSED
    // The host. It keeps a request until it is done.
    input write,
    input read,
    input [MOTOR_BITS-1:0] host_motor,
    input [19:1] host_address,  // in the map: writes words of 64 bits, reads limbs of 16
    input [63:0] write_data,
    output reg written,         // for one clock, and its address is still there
    output reg was_read,        // for one clock
    output [15:0] read_data,    // then
    // The memory, while the core does not use it.
    input core_uses_memory,
    output reg stores,
    output reg [12:0] address,
    output reg [15:0] data,
    input [15:0] word,
    // The core.
    input may_write,
    output writes,
    input [MOTOR_BITS-1:0] motor,
    input untouch,
    output reg [MOTORS-1:0] is_touched
    // verilator lint_on UNUSED
);
    wire is_ring = host_address[19:17] != 0 || host_address[16];
    wire is_constant = !is_ring && host_address[13:8] == 0 && host_address[7:3] != 4;
    reg [12:0] asked;
    always @* casez (host_address[19:16])
        4'b1???: asked = {3'b100, host_address[10:1]};
        4'b0101: asked = {4'b1011, host_address[9:1]};
        4'b0100: asked = {4'b1010, host_address[9:1]};
        4'b001?: asked = {1'b0, host_address[12:1]};
        default: asked = host_address[13] ? {5'b11001, host_address[8:1]} :
            host_address[12] ? {5'b11000, host_address[8:1]} :
            host_address[8] ? {6'b110100, host_address[7:1]} : {11'b11010011111, host_address[2:1]};
    endcase

    // An access is prepared, and made when the core does not use the memory.
    reg [1:0] limb;
    reg asks;                   // an access is prepared
    reg begun;                  // a word is being written
    reg reads;                  // what was asked for comes in the next clock
    wire begins = !asks && (write ? !written && (begun || is_ring || may_write) : read && !reads && !was_read);
    wire is_done = asks && !core_uses_memory;
    wire is_last = stores && limb == 3;
    assign writes = begun;

    (* no_rw_check *) reg [15:0] constants[0:127];
    reg [15:0] constant;
    reg was_constant;
    assign read_data = was_constant ? constant : word;
    integer i;
    initial {limb, begun, reads, written, was_read, was_constant, is_touched, asks, stores, address, data} = 0;
    always @(posedge clk) begin
        asks <= begins || (asks && core_uses_memory);
        written <= is_done && is_last;
        reads <= is_done && !stores;
        was_read <= reads;
        was_constant <= is_constant;
        constant <= constants[host_address[7:1]];
        stores <= begins ? write : stores && !is_done;
        if (begins) begin
            begun <= write;
            address <= write ? {asked[12:2], limb} : asked;
            case (limb)
                0: data <= write_data[15:0];
                1: data <= write_data[31:16];
                2: data <= write_data[47:32];
                default: data <= write_data[63:48];
            endcase
        end else if (is_done && is_last) begun <= 0;
        if (is_done && stores) limb <= limb + 1'b1;
    end
    genvar n;
    generate for (n = 0; n < MOTORS; n = n + 1) begin : motors
        always @(posedge clk) begin
            if (written && !is_ring && host_motor == n) is_touched[n] <= 1;
            else if (untouch && motor == n) is_touched[n] <= 0;
        end
    end endgenerate
    `include "rtl/motors/motors_constants.vh"
endmodule
