// The devices of several motors behind their register maps (sim_fpga/REGISTERS.md), run by one core. Each makes every
// step in the same tick as sim_fpga/device.hpp, and shows the same words.
//
// The host asks for the words of a motor (`show`); then they stay as they are until it asks again. Pieces are run from
// the segment ring. There are no encoders, and no pulses at places.
module motors_device #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3,
    parameter HAS_MEMORY = 1,   // 0: the memory is outside
    parameter [15:0] CHECKS = 1 // motors_core.v
) (
    input clk,
    input tick,                 // for one clock: another tick
    output busy,                // it is being executed
    output take,                // for one clock: its execution begins
    // The host, as in motors_host.v.
    input write,
    input read,
    input [MOTOR_BITS-1:0] host_motor,
    input [19:1] host_address,
    input [63:0] write_data,
    output written,
    output was_read,
    output [15:0] read_data,
    input show,                 // for one clock: shows the words of host_motor
    output shows,               // until it is done
    // The memory, if it is outside. It writes or reads in each clock, as motors_memory.v does.
    output memory_writes,
    output [MOTOR_BITS+12:0] memory_address,
    output [15:0] memory_data,
    // verilator lint_off UNUSED
    input [15:0] memory_word,
    // verilator lint_on UNUSED
    // The pins.
    input [15*MOTORS-1:0] pins,
    output [MOTOR_BITS-1:0] motor, // of what follows, each for one clock
    output step_forward,
    output step_backward,
    output set_levels,
    output set_enable,
    output set_times,
    output set_analog,
    output [2:0] channel,
    output [15:0] data
);
    wire core_uses, core_stores, host_stores, may_write, host_writes, untouch;
    wire [12:0] core_address, address;
    wire [15:0] host_data, word;
    wire [MOTORS-1:0] is_touched;
    // verilator lint_off PINCONNECTEMPTY
    motors_core #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS), .CHECKS(CHECKS)) core (.clk(clk), .tick(tick),
        .busy(busy), .take(take), .motor(motor), .uses_memory(core_uses), .stores(core_stores), .address(core_address),
        .data(data), .word(word), .is_between(), .may_write(may_write), .host_writes(host_writes),
        .is_touched(is_touched), .untouch(untouch), .show(show), .show_motor(host_motor), .shows(shows),
        .pins(pins[15*motor +: 15]), .step_forward(step_forward), .step_backward(step_backward),
        .set_levels(set_levels), .set_enable(set_enable), .set_times(set_times), .set_analog(set_analog),
        .channel(channel));
    // verilator lint_on PINCONNECTEMPTY
    motors_host #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS)) host (.clk(clk), .write(write), .read(read),
        .host_motor(host_motor), .host_address(host_address), .write_data(write_data), .written(written),
        .was_read(was_read), .read_data(read_data), .core_uses_memory(core_uses),
        .stores(host_stores), .address(address), .data(host_data), .word(word), .may_write(may_write),
        .writes(host_writes), .motor(motor), .untouch(untouch), .is_touched(is_touched));
    assign memory_writes = core_stores || (host_stores && !core_uses);
    assign memory_address = core_uses ? {motor, core_address} : {host_motor, address};
    assign memory_data = core_uses ? data : host_data;
    generate if (HAS_MEMORY != 0) begin : own_memory
        motors_memory #(.MOTORS(MOTORS), .MOTOR_BITS(MOTOR_BITS)) memory (.clk(clk), .write(memory_writes),
            .address(memory_address), .data(memory_data), .word(word));
    end else begin : memory_outside
        assign word = memory_word;
    end endgenerate
endmodule
