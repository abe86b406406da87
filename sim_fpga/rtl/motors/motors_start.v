// When the clock of the motors may begin: when `fast`, of which it is made, is stable and has run for 4,096 periods.
// For some microseconds behind its configuration an iCE40's block RAM reads as 0, and so would the program.
module motors_start (
    input fast,
    input is_stable,            // `fast` is; it belongs to no clock
    output begun
);
    reg [1:0] stable;
    reg [12:0] periods;
    assign begun = periods[12];
    initial {stable, periods} = 0;
    always @(posedge fast) begin
        stable <= {stable[0], is_stable};
        if (!begun) periods <= stable[1] ? periods + 1'b1 : 13'd0;
    end
endmodule
