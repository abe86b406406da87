// Whether the host still beats. It is sim_fpga/host_watch.hpp.
module axis_host_watch (
    input clk,
    input begins,               // a setup was taken
    input look,                 // at the host's beat
    input beats,                // there: it has changed
    input tick,                 // another tick
    input judge,                // whether the host is silent
    input [31:0] patience,      // in ticks; 0: the host is never silent
    output falls_silent,        // in this clock
    output reg is_silent
);
    reg [31:0] ticks;           // since the last change of the beat
    assign falls_silent = judge && patience != 0 && ticks >= patience && !is_silent && !begins && !is_heard;
    wire is_heard = look && beats;
    initial {ticks, is_silent} = 0;
    always @(posedge clk) begin
        if (begins || is_heard) ticks <= 0;
        else if (tick && ticks != 32'hffffffff) ticks <= ticks + 1'b1;
        if (begins || is_heard) is_silent <= 0;
        else if (falls_silent) is_silent <= 1;
    end
endmodule
