// The state machine with a delay counter: finds the origin of a linear slide, and drives its head to destinations.
//
// Source: Lam and Ehkan, Section III.B and Fig. 3. The clock has 10 kHz in the paper. After each clock all registers
// have the values of LamController::clock (core/methods/lam_controller.hpp), which lists what the paper leaves open.
module lam_controller #(
    parameter BITS = 16,
    parameter DELAY_BITS = 8,
    parameter HOME = 50,
    parameter BRAKE = 5,             // pulses before the destination at which the head begins to decelerate
    parameter RECOVERY = 10000,      // clocks between a limit and the next search of the origin
    parameter RECOVERY_BITS = 14
) (
    input clk,
    input reset,
    input left_limit,
    input right_limit,
    input data_ready,                // the destination is valid; it is taken in STANDBY
    input [BITS-1:0] destination,
    output reg pulse,
    output reg right,                // the direction
    output reg [2:0] state,
    output [BITS-1:0] location,
    output [DELAY_BITS-1:0] delay
);
    localparam INITIALIZE = 0, STANDBY = 1, ACCELERATE = 2, CRUISE = 3, DECELERATE = 4, STOP = 5;

    reg [RECOVERY_BITS-1:0] recovery; // clocks until INITIALIZE; 0: no limit was reached
    wire recovered = recovery == 1;
    wire [BITS-1:0] distance;
    wire to_right, due, cruising;

    wire moving = state == ACCELERATE || state == CRUISE || state == DECELERATE;
    wire blocked = right ? right_limit : left_limit;
    wire ready = state == STANDBY && recovery == 0 && data_ready;
    wire begins = ready && distance != 0;
    wire counts = state == INITIALIZE ? !left_limit : moving && !blocked;
    wire pulses = counts && due;
    wire arrives = distance == 1;
    wire braking = distance <= BRAKE + 1; // after this pulse
    wire restart = reset || begins || state == STOP || (state == STANDBY && recovered);

    lam_location #(.BITS(BITS), .HOME(HOME)) place (
        .clk(clk), .origin(state == STOP), .take(ready), .pulse(pulses), .right(right), .destination(destination),
        .location(location), .distance(distance), .to_right(to_right));
    lam_delay #(.BITS(DELAY_BITS)) waits (
        .clk(clk), .restart(restart), .count(counts),
        .accelerate(state == ACCELERATE && !braking), .decelerate(moving && braking && !arrives),
        .due(due), .cruising(cruising), .delay(delay));

    initial state = INITIALIZE;
    always @(posedge clk) begin
        pulse <= pulses && !reset;
        if (reset) begin
            state <= INITIALIZE;
            right <= 0;
            recovery <= 0;
        end else case (state)
            INITIALIZE:
                if (left_limit) state <= STOP;
            STOP: begin
                right <= 1;
                state <= HOME <= BRAKE ? DECELERATE : ACCELERATE;
            end
            STANDBY:
                if (recovery != 0) begin
                    recovery <= recovery - 1'b1;
                    if (recovered) begin
                        right <= 0;
                        state <= INITIALIZE;
                    end
                end else if (begins) begin
                    right <= to_right;
                    state <= distance <= BRAKE ? DECELERATE : ACCELERATE;
                end
            default:
                if (blocked) begin
                    recovery <= RECOVERY;
                    state <= STANDBY;
                end else if (pulses) begin
                    if (arrives) state <= STANDBY;
                    else if (braking) state <= DECELERATE;
                    else if (state == ACCELERATE && cruising) state <= CRUISE;
                end
        endcase
    end
endmodule
