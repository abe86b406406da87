// The memory of all motors in an asynchronous SRAM beside the chip. It writes or reads in each clock, as
// motors_memory.v does.
//
// A clock that writes has the pulse of we_n and the data in its second half, so that the address is there before. The
// pulse ends with an edge of `fast`. The address changes with `clk`, which is later by the way through a register to
// the clock's net. While it writes, oe_n is off, so that one side alone drives the data.
module motors_sram #(
    parameter ADDRESS_BITS = 16
) (
    input fast,
    input clk,                  // half of `fast`
    input write,
    input [ADDRESS_BITS-1:0] address,
    input [15:0] data,
    output reg [15:0] word,     // two clocks after the address
    // The SRAM's pins.
    output reg we_n,
    output reg oe_n,
    output reg [ADDRESS_BITS-1:0] pin_address,
    output reg drives,          // the chip drives the data
    output reg [15:0] pin_data,
    input [15:0] pin_word
);
    wire pulses = oe_n && clk;  // the next half of the clock is the second one
    initial {we_n, oe_n, drives} = 3'b100;
    initial {pin_address, pin_data, word} = 0;
    always @(posedge fast) begin
        we_n <= !pulses;
        drives <= pulses;
    end
    always @(posedge clk) begin
        oe_n <= write;
        pin_address <= address;
        pin_data <= data;
        word <= pin_word;
    end
endmodule
