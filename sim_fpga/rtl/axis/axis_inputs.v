// The inputs: each follows its pin once the pin has kept its level for its DEBOUNCE. It is sim_fpga/input_filter.hpp,
// one input after the other: two clocks for each if one differs from its pin, else one clock for all.
module axis_inputs #(
    parameter INPUTS = 8
) (
    input clk,
    input [INPUTS-1:0] pins,
    input [INPUTS-1:0] inverted, // these are closed while their pin is low
    input invert,               // for one clock, in which `inverted` becomes next_inverted: they change at once
    input [INPUTS-1:0] next_inverted,
    input set_debounce,         // for one clock: of this input
    input [4:0] debounce_input,
    input [31:0] debounce_ticks,
    input [31:0] now,
    input look,                 // for one clock: look at the pins
    output busy,                // from the clock after `look` on
    output reg [INPUTS-1:0] closed
);
    reg [31:0] debounce[0:31], since[0:31]; // `since`: of the pending ones, when the pin changed
    reg [31:0] debounce_word, since_word;
    reg [INPUTS-1:0] pending;   // the pin has another level than the input
    reg [INPUTS-1:0] different; // the same at this look
    reg [INPUTS-1:0] changed;
    reg [4:0] at;
    reg asked, scans;           // the memory shows the words of `at`; a look goes on
    wire [INPUTS-1:0] differs = pins ^ inverted ^ closed;
    wire [INPUTS-1:0] one = {{(INPUTS - 1){1'b0}}, 1'b1} << at;
    wire is_pending = (pending & one) != 0;
    wire is_different = (different & one) != 0;
    wire is_due = is_different && (is_pending ? now - since_word >= debounce_word : debounce_word == 0);
    wire [INPUTS-1:0] due = is_due ? one : {INPUTS{1'b0}};
    wire is_last = {27'd0, at} == INPUTS - 1;
    assign busy = scans;

    integer i;
    initial begin
        {closed, pending, different, changed, at, asked, scans} = 0;
        for (i = 0; i < 32; i = i + 1) begin
            debounce[i] = 0;
            since[i] = 0;
        end
    end
    always @(posedge clk) begin
        debounce_word <= debounce[at];
        since_word <= since[at];
        if (set_debounce) debounce[debounce_input] <= debounce_ticks;
        if (scans && asked && is_different && !is_pending) since[at] <= now;
    end
    always @(posedge clk) begin
        asked <= scans && !asked;
        if (look && (differs != 0 || pending != 0)) begin
            scans <= 1;
            different <= differs;
            changed <= 0;
            at <= 0;
        end else if (scans && asked) begin
            at <= at + 1'b1;
            changed <= changed | due;
            if (is_last) begin
                scans <= 0;
                closed <= closed ^ changed ^ due;
                pending <= different & ~changed & ~due;
            end
        end
        if (invert) closed <= closed ^ inverted ^ next_inverted;
    end
endmodule
