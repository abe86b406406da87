// The analog outputs: a pin is on in so many of 2^15 looks as its value says, spread evenly. A low-pass filter makes a
// voltage of it. In each clock one of the outputs is looked at, so that all share an adder.
module motors_analog #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3,
    parameter ANALOG = 2        // at most 2
) (
    input clk,
    input set_level,            // for one clock: `channel` of `motor` becomes `level`
    input [MOTOR_BITS-1:0] motor,
    input channel,
    input [15:0] level,         // up to 2^15
    output reg [ANALOG*MOTORS-1:0] pins
);
    (* no_rw_check *) reg [15:0] levels[0:255];
    (* no_rw_check *) reg [14:0] rests[0:255];
    reg [15:0] its_level;
    reg [14:0] its_rest;
    reg [3:0] at, seen;
    wire [15:0] sum = its_level + {1'b0, its_rest};
    integer i;
    initial begin
        {at, seen, its_level, its_rest, pins} = 0;
        for (i = 0; i < 256; i = i + 1) begin
            levels[i] = 0;
            rests[i] = 0;
        end
    end
    always @(posedge clk) begin
        at <= at + 1'b1;
        seen <= at;
        if (set_level) levels[{4'd0, motor, channel}] <= level;
        its_level <= levels[{4'd0, at}];
        its_rest <= rests[{4'd0, at}];
        rests[{4'd0, seen}] <= sum[14:0];
    end
    genvar n;
    generate for (n = 0; n < ANALOG * MOTORS; n = n + 1) begin : outputs
        always @(posedge clk) if (seen == n / ANALOG * 2 + n % ANALOG) pins[n] <= sum[15];
    end endgenerate
endmodule
