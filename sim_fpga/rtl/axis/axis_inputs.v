// The inputs: each follows its pin once the pin has kept its level for its DEBOUNCE. It is sim_fpga/input_filter.hpp,
// one input after the other: two clocks for each if one differs from its pin, else one clock for all. A change takes as
// long as its event.
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
    input tick,                 // for one clock: another tick
    input look,                 // for one clock: look at the pins
    output busy,                // from the clock after `look` on
    output reg [INPUTS-1:0] closed, // changes when a look ends
    // A change, for one clock; the next one comes when `wait_for_event` is low.
    output changes,
    output [4:0] changed_input,
    output changed_closed,
    input wait_for_event
);
    (* no_rw_check *) reg [31:0] debounce[0:31];
    (* no_rw_check *) reg [31:0] since[0:31]; // of the pending ones, when the pin changed
    reg [31:0] debounce_word, since_word;
    reg [31:0] now;             // ticks since power-up
    reg [INPUTS-1:0] pending;   // the pin has another level than the input
    reg [INPUTS-1:0] different; // the same at this look
    reg [INPUTS-1:0] changed;
    reg [4:0] at;
    reg asked, scans;           // the memory shows the words of `at`; a look goes on
    reg notes;                  // what goes on is no look: it notes the inputs that are in `changed`
    wire [INPUTS-1:0] differs = pins ^ inverted ^ closed;
    wire [INPUTS-1:0] one = {{(INPUTS - 1){1'b0}}, 1'b1} << at;
    wire is_pending = (pending & one) != 0;
    wire is_different = (different & one) != 0;
    wire is_due = !notes && is_different && (is_pending ? now - since_word >= debounce_word : debounce_word == 0);
    wire [INPUTS-1:0] due = is_due ? one : {INPUTS{1'b0}};
    wire is_last = {27'd0, at} == INPUTS - 1;
    wire is_changed = notes && (changed & one) != 0;
    assign busy = scans || wait_for_event;
    assign changes = scans && asked && (is_due || is_changed);
    assign changed_input = at;
    assign changed_closed = ((closed & one) != 0) == is_changed;

    integer i;
    initial begin
        {now, closed, pending, different, changed, at, asked, scans, notes} = 0;
        for (i = 0; i < 32; i = i + 1) begin
            debounce[i] = 0;
            since[i] = 0;
        end
    end
    always @(posedge clk) begin
        debounce_word <= debounce[at];
        since_word <= since[at];
        if (set_debounce) debounce[debounce_input] <= debounce_ticks;
        if (scans && asked && !notes && is_different && !is_pending) since[at] <= now;
    end
    always @(posedge clk) begin
        if (tick) now <= now + 1'b1;
        asked <= scans && !asked && !wait_for_event;
        if (look && (differs != 0 || pending != 0)) begin
            scans <= 1;
            different <= differs;
            changed <= 0;
            at <= 0;
        end else if (scans && asked) begin
            at <= at + 1'b1;
            if (!notes) changed <= changed | due;
            if (is_last) {scans, notes} <= 0;
            if (is_last && !notes) begin
                closed <= closed ^ changed ^ due;
                pending <= different & ~changed & ~due;
            end
        end
        if (invert) begin
            closed <= closed ^ inverted ^ next_inverted;
            changed <= inverted ^ next_inverted;
            {scans, notes} <= 2'b11;
            at <= 0;
        end
    end
endmodule
