// The add-only engine of N motors with one adder: the registers of all motors are in memory, and the adder serves one
// word of one motor in each clock.
//
// Every motor makes the same steps in the same ticks as add_only_axis.v. A number has two words of LIMB bits. A motor
// takes six slots of one clock each:
//   TICKS   ticks left -= 1
//   VLO     velocity += acceleration, low word
//   PLO     phase += velocity, low word; the sum of the slot before is an operand
//   VHI     velocity, high word, with the carry of VLO
//   PHI     phase, high word, with the carry of PLO; its carry or borrow is the step
//   HOST    the host may write a word
// A slot passes through three stages, one clock each: read, operands, sum and write.
//
// Each motor has two banks, each for one piece. The host writes a whole piece into the bank that is not full, then
// marks it full. The engine runs a piece in its bank, marks the bank empty after the last tick and continues with the
// other bank in the next tick, if that is full. So pieces follow each other without a gap.
module add_only_engine #(
    parameter N = 6,
    parameter MOTOR_BITS = 3,  // 2 to the power of it is at least N
    parameter LIMB = 32,
    parameter ROUNDS = N       // at least N: a tick has 6 * ROUNDS clocks
) (
    input clk,
    // The host's words: {motor, WORD}, see below. A write waits for `written`.
    input write,
    input [MOTOR_BITS+3:0] write_address,
    input [LIMB-1:0] write_data,
    output written,
    input mark,                // for one clock: this motor's bank is full
    input [MOTOR_BITS-1:0] mark_motor,
    input mark_bank,
    output [2*N-1:0] full,     // of bank b of motor m: bit 2 m + b
    output reg tick,           // for one clock: the steps of a tick, all motors at once
    output reg [N-1:0] forward,
    output reg [N-1:0] backward
);
    localparam [MOTOR_BITS-1:0] LAST = ROUNDS - 1, LAST_MOTOR = N - 1;
    localparam TICKS = 0, VLO = 1, PLO = 2, VHI = 3, PHI = 4, HOST = 5;

    // The slots, and which motor each belongs to, in all three stages.
    reg [2:0] slot, slot1, slot2;
    reg [MOTOR_BITS-1:0] motor, motor1, motor2;
    reg run, run1, run2;       // the motor has a piece
    reg bank;                  // the motor's present one
    wire last_slot = slot == HOST;

    // WORD: 0 TICKS, 2 VLO, 4 VHI of bank 0, and 1, 3, 5 of bank 1; 6 PLO, 7 PHI. Those are the words that change. 8,
    // 10 are the acceleration's low and high word of bank 0, 9, 11 of bank 1.
    (* no_rw_check *) reg [LIMB-1:0] changing[0:(8 << MOTOR_BITS)-1];
    (* no_rw_check *) reg [LIMB-1:0] constant[0:(4 << MOTOR_BITS)-1];
    reg [LIMB-1:0] changing_q, constant_q;
    reg [2:0] word, word1, word2;
    always @* case (slot)
        TICKS: word = {2'd0, bank};
        VLO: word = {2'd1, bank};
        VHI: word = {2'd2, bank};
        PLO: word = 6;
        default: word = 7;
    endcase

    // The adder.
    reg [LIMB-1:0] a, b;
    reg carry_in, carry1;
    wire [LIMB:0] sum = {1'b0, a} + {1'b0, b} + {{LIMB{1'b0}}, carry_in};

    assign written = write && slot2 == HOST;
    wire engine_writes = run2 && slot2 != HOST;
    wire host_writes = written && !write_address[3];
    wire [MOTOR_BITS+2:0] changing_address = host_writes ? {write_address[MOTOR_BITS+3:4], write_address[2:0]}
                                                         : {motor2, word2};
    always @(posedge clk) begin
        changing_q <= changing[{motor, word}];
        constant_q <= constant[{motor, slot == VHI, bank}];
        if (engine_writes || host_writes) changing[changing_address] <= host_writes ? write_data : sum[LIMB-1:0];
        if (written && write_address[3]) constant[{write_address[MOTOR_BITS+3:4], write_address[1:0]}] <= write_data;

        a <= changing_q;
        b <= slot1 == TICKS ? {LIMB{1'b1}} : slot1 == PLO || slot1 == PHI ? sum[LIMB-1:0] : constant_q;
        carry_in <= (slot1 == VHI || slot1 == PHI) && carry1;
        carry1 <= sum[LIMB];
    end

    // The banks: full ones, and which one each motor runs. A piece that was marked during a motor's slots waits a tick.
    reg [2*N-1:0] banks_full;
    reg [N-1:0] present;
    reg last;                  // this tick is the last one of the piece
    assign full = banks_full;
    wire [MOTOR_BITS-1:0] following = motor == LAST ? 0 : motor + 1'b1;
    wire commit = slot2 == HOST && motor2 == LAST;

    integer i;
    initial begin
        slot = 0; slot1 = HOST; slot2 = HOST; motor = 0; motor1 = 0; motor2 = 0; run = 0; run1 = 0; run2 = 0; bank = 0;
        word1 = 0; word2 = 0;
        banks_full = 0; present = 0; tick = 0; forward = 0; backward = 0; forward_next = 0; backward_next = 0;
        for (i = 0; i < 8 << MOTOR_BITS; i = i + 1) changing[i] = i % 8 == 7 ? {1'b1, {(LIMB - 1){1'b0}}} : 0;
        for (i = 0; i < 4 << MOTOR_BITS; i = i + 1) constant[i] = 0;
    end

    reg [N-1:0] forward_next, backward_next;
    always @(posedge clk) begin
        slot <= last_slot ? TICKS : slot + 1'b1;
        {slot1, slot2} <= {slot, slot1};
        {motor1, motor2} <= {motor, motor1};
        {run1, run2} <= {run, run1};
        {word1, word2} <= {word, word1};
        if (last_slot) begin
            motor <= following;
            run <= following <= LAST_MOTOR && banks_full[{following, present[following]}];
            bank <= present[following];
        end
        if (slot2 == TICKS) last <= run2 && sum[LIMB-1:0] == 0;
        if (slot == PHI && last) begin
            banks_full[{motor, bank}] <= 0;
            present[motor] <= !bank;
        end
        if (mark) banks_full[{mark_motor, mark_bank}] <= 1;

        if (slot2 == PHI && motor2 <= LAST_MOTOR) begin
            forward_next[motor2] <= run2 && sum[LIMB] && !b[LIMB-1];
            backward_next[motor2] <= run2 && !sum[LIMB] && b[LIMB-1];
        end
        tick <= commit;
        if (commit) begin
            forward <= forward_next;
            backward <= backward_next;
        end
    end
`ifdef PROOF
`include "add_only_engine_properties.vh"
`endif
endmodule
