// Two axes from a serial line to the motors' phases: UART, download, velocity planner, a DDA and a driver for each
// axis.
//
// Source: Lai, Chien, Tsao, Fig. 1. The period of 6.5 ms is 256 clocks of the DDA, here of 305 clocks of 12 MHz each.
// The next line is downloaded while one runs, so lines follow each other without a pause.
module two_axis_controller #(
    parameter CLOCKS_PER_BIT = 625, // 19,200 baud
    parameter BIT_BITS = 10,
    parameter [8:0] LAST_CLOCK = 304 // clocks of a DDA clock less one; at least 3
) (
    input clk,
    input reset,
    input serial,
    input [7:0] v_max,
    input round_each,
    input derivative,
    input limit_remaining,
    output line_waits,        // a line is downloaded and not begun yet
    output reg dda_clock,     // for one clock; the pulses come in the next one
    output reg period_end,    // for one clock, after the last DDA clock of a period
    output x_pulse,
    output y_pulse,
    output reg x_backward,
    output reg y_backward,
    output [3:0] x_phases,
    output [3:0] y_phases
);
    wire byte_valid, taken, planned, plan_x_backward, plan_y_backward;
    wire [7:0] received, x_pulses, y_pulses;
    wire [15:0] x, y;

    uart_receiver #(.CLOCKS_PER_BIT(CLOCKS_PER_BIT), .BITS(BIT_BITS)) uart (
        .clk(clk), .reset(reset), .line(serial), .valid(byte_valid), .byte_out(received));
    line_download download (
        .clk(clk), .reset(reset), .byte_valid(byte_valid), .byte_in(received), .valid(line_waits), .taken(taken),
        .x(x), .y(y));
    two_axis_planner planner (
        .clk(clk), .reset(reset), .line_valid(line_waits), .line_taken(taken), .x(x), .y(y), .v_max(v_max),
        .round_each(round_each), .derivative(derivative), .limit_remaining(limit_remaining), .ready(planned),
        .taken(period_end), .x_pulses(x_pulses), .y_pulses(y_pulses), .x_backward(plan_x_backward),
        .y_backward(plan_y_backward));

    reg [8:0] clock;
    reg [7:0] dda_clocks;
    always @(posedge clk) begin
        dda_clock <= !reset && clock == LAST_CLOCK;
        clock <= reset || clock == LAST_CLOCK ? 0 : clock + 1'b1;
        if (reset) dda_clocks <= 0;
        else if (dda_clock) dda_clocks <= dda_clocks + 1'b1;
        period_end <= !reset && dda_clock && dda_clocks == 255;
        if (period_end) {x_backward, y_backward} <= {plan_x_backward, plan_y_backward};
    end

    dda x_dda (
        .clk(clk), .reset(reset), .load(period_end), .pulses(planned ? x_pulses : 8'd0), .clock(dda_clock),
        .pulse(x_pulse));
    dda y_dda (
        .clk(clk), .reset(reset), .load(period_end), .pulses(planned ? y_pulses : 8'd0), .clock(dda_clock),
        .pulse(y_pulse));
    phase_driver x_driver (
        .clk(clk), .reset(reset), .step(x_pulse), .backward(x_backward), .half(1'b0), .phases(x_phases));
    phase_driver y_driver (
        .clk(clk), .reset(reset), .step(y_pulse), .backward(y_backward), .half(1'b0), .phases(y_phases));
endmodule
