// Whether the host still beats. It is sim_fpga/host_watch.hpp.
module axis_host_watch (
    input clk,
    input begins,               // a setup was taken
    input look,                 // at the host's beat
    input [63:0] beat,
    input tick,                 // another tick
    input judge,                // whether the host is silent
    input [31:0] patience,      // in ticks; 0: the host is never silent
    output falls_silent,        // in this clock
    output reg is_silent
);
    reg [63:0] last_beat;
    reg [31:0] ticks;           // since the last change of the beat
    assign falls_silent = judge && patience != 0 && ticks >= patience && !is_silent && !begins && !beats;
    wire beats = look && beat != last_beat;
    initial {last_beat, ticks, is_silent} = 0;
    always @(posedge clk) begin
        if (look) last_beat <= beat;
        if (begins || beats) ticks <= 0;
        else if (tick && ticks != 32'hffffffff) ticks <= ticks + 1'b1;
        if (begins || beats) is_silent <= 0;
        else if (falls_silent) is_silent <= 1;
    end
endmodule
