// One processor that runs the devices of all motors, one motor after the other in each tick. It has one adder of 16
// bits. The state of each motor is in registers, which are block RAM, and in memory. The program is in block RAM
// (program/*.asm, put together by assemble.py). So another motor costs memory and clocks, and hardly a cell.
//
// An instruction is read (`ins`), reads its registers, is executed (x_), and writes its result (w_), a clock each. It
// does so for up to four limbs of 16 bits, from the lowest one on, with the carry from one to the next. It waits until
// its registers are written, as long as the assembler says. A word from memory is written a clock later (v_); the
// assembler leaves that clock free. A jump drops the three instructions behind it.
module motors_core #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3,
    parameter [15:0] CHECKS = 1 // pieces of the next frame, or changes of its outputs, that are checked in a tick
) (
    input clk,
    input tick,                 // for one clock: another tick
    output busy,                // it is being executed, or waits
    output take,                // for one clock: the execution of a tick begins
    output reg [MOTOR_BITS-1:0] motor,
    // The memory: the word comes two clocks after its address.
    output reg uses_memory,
    output stores,              // and `uses_memory`
    output [12:0] address,
    output [15:0] data,
    input [15:0] word,
    // The host.
    output reg is_between,      // between two ticks
    output may_write,           // the host may begin to write words
    input host_writes,          // it writes
    input [MOTORS-1:0] is_touched, // the host has written words of a motor
    output untouch,             // for one clock: they are read
    input show,                 // for one clock: shows the words of this motor
    input [MOTOR_BITS-1:0] show_motor,
    output shows,
    // The present motor's pins, and what they shall be: for one clock, as `data` says.
    input [14:0] pins,
    output step_forward,
    output step_backward,
    output set_levels,
    output set_enable,
    output set_times,
    output set_analog,
    output [2:0] channel        // of the analog output
);
    localparam [3:0] ADD = 1, SUB = 2, CMP = 3, MOV = 4, ANDN = 6, OR = 7, XOR = 8, TST = 9, LD = 10, ST = 11,
        JUMP = 12, FUNCTION = 13;
    localparam [1:0] REGISTER = 0, NUMBER = 1, PINS = 2, BLOCK = 3, CALL = 1, RETURN = 2;
    localparam [6:0] LAST_OF_BLOCK = 95;
    localparam BITS = MOTOR_BITS + 8;

    // The instruction.
    (* no_rw_check *) reg [34:0] words[0:1023];
    reg [34:0] ins;
    reg [9:0] pc, target;
    reg is_ins;                 // there is one
    reg takes;                  // a jump was executed: what is behind it is dropped
    reg [1:0] waited;
    reg [6:0] limb;
    reg is_limb_0;
    wire [3:0] op = ins[31:28];
    wire [1:0] kind = ins[25:24];
    wire is_block = op == ST && kind == BLOCK;
    wire waits = waited != ins[33:32];
    // Whether the next one is read is known in the clock before, or from a bit of the instruction: it is far to all
    // registers that this enables.
    reg is_first;               // this clock is the first one of an instruction
    reg is_last;                // it is the last one, or there is no instruction
    wire advances = takes || is_last || (is_first && ins[34]);
    wire will_wait = waited + 1'b1 != ins[33:32];
    integer i;
    initial {pc, is_ins, is_first, waited, limb, ins} = 0;
    initial {is_last, is_limb_0} = 2'b11;
    always @(posedge clk) begin
        if (advances) ins <= words[pc];
        is_ins <= !takes;
        is_first <= advances && !takes;
        if (advances) is_last <= takes;
        else if (waits) is_last <= !will_wait && !is_block && ins[27:26] == 0;
        else is_last <= is_block ? limb == LAST_OF_BLOCK - 1'b1 : limb[1:0] + 1'b1 == ins[27:26];
        if (advances) pc <= takes ? target : pc + 1'b1;
        if (advances) {waited, limb} <= 0;
        else if (waits) waited <= waited + 1'b1;
        else limb <= limb + 1'b1;
        is_limb_0 <= advances || (is_limb_0 && waits);
    end

    // Its registers.
    (* no_rw_check *) reg [15:0] registers_a[0:(1 << BITS)-1];
    (* no_rw_check *) reg [15:0] registers_b[0:(1 << BITS)-1];
    reg [15:0] a, b;
    reg x_is, x_first;
    reg [3:0] x_op;
    reg [1:0] x_kind;
    reg [7:0] x_at;
    reg [6:0] x_limb;
    reg [15:0] x_number;
    wire [7:0] at = ins[23:16] | {1'b0, limb};
    reg w_writes, w_loads, w_first, w_judges, v_loads;
    reg [7:0] w_at, v_at;
    reg [15:0] sum, bits;
    wire [15:0] result = v_loads ? word : sum | bits;
    wire [7:0] result_at = v_loads ? v_at : w_at;
    wire writes = w_writes || v_loads;
    initial {x_is, x_first, x_op, x_kind, x_at, x_limb, x_number} = 0;
    always @(posedge clk) begin
        if (writes) registers_a[{motor, result_at}] <= result;
        if (writes) registers_b[{motor, result_at}] <= result;
        a <= registers_a[{motor, at}];
        b <= registers_b[{motor, ins[7:0] | {6'd0, limb[1:0]}}];
    end
    always @(posedge clk) begin
        x_is <= is_ins && !takes && !waits;
        x_first <= is_limb_0;
        x_op <= op;
        x_kind <= kind;
        x_at <= at;
        x_limb <= limb;
        if (kind == NUMBER && !is_limb_0) x_number <= 0;
        else x_number <= kind != PINS ? ins[15:0] : ins[0] ? CHECKS : {1'b0, pins};
    end

    // Executes it.
    reg x_adds, x_inverts, x_is_number, x_is_logical, x_writes;
    // The last addition's. Of the clock before: the carry, inverted if it subtracts. So the carry is a sum's bit, whose
    // cell has the register, too.
    reg carry, sign_a, sign_b, zero, w_carry, w_adds, w_inverts;
    wire runs = x_is && !takes;
    wire [15:0] other = (x_is_number ? x_number : b) ^ {16{x_inverts}};
    wire carries = x_inverts ^ (!x_first && w_carry);
    wire [16:0] sums = {x_inverts, a} + {1'b0, other} + {16'd0, carries};
    reg [15:0] logical;
    always @* case (x_op)
        MOV: logical = other;
        OR: logical = a | other;
        XOR: logical = a ^ other;
        default: logical = a & other;
    endcase
    wire has_carry = w_adds ? w_carry ^ w_inverts : carry;
    always @(posedge clk) begin
        x_adds <= op <= CMP;
        x_inverts <= op == SUB || op == CMP || op == ANDN;
        x_is_number <= kind != REGISTER;
        x_is_logical <= op >= MOV && op <= TST;
        x_writes <= op >= ADD && op <= XOR && op != CMP;
        sum <= x_adds ? sums[15:0] : 16'd0;
        bits <= x_is_logical ? logical : 16'd0;
        w_carry <= sums[16];
        w_inverts <= x_inverts;
        carry <= has_carry;
        w_adds <= runs && x_adds;
        if (runs && x_adds) {sign_a, sign_b} <= {a[15], other[15] ^ x_inverts};
        w_writes <= runs && x_writes;
        w_loads <= runs && x_op == LD;
        {v_loads, v_at} <= {w_loads, w_at};
        w_at <= x_at;
        w_first <= x_first;
        w_judges <= runs && (x_adds || x_is_logical);
        if (w_judges) zero <= (w_first || zero) && (sum | bits) == 0;
    end

    // The memory.
    reg [12:0] pointer;
    reg x_stores;
    assign stores = x_stores && !takes; // what a jump drops only reads
    initial {uses_memory, x_stores} = 0;
    always @(posedge clk) begin
        uses_memory <= is_ins && !takes && !waits && (op == LD || op == ST);
        x_stores <= is_ins && !takes && !waits && op == ST;
    end
    assign address = (x_number[15] ? pointer : 13'd0) | x_number[12:0] | {6'd0, x_limb};
    assign data = a;
    assign channel = pointer[4:2];

    // Jumps.
    reg [3:0] ticks;            // that have come and have not begun
    reg may_tick, is_last_motor, touched; // a clock later
    reg overruns, is_late;      // a tick came before the execution of the one before it had begun: since then, now
    reg asks_show;
    reg is_shown;
    reg condition;
    wire is_tick = ticks != 0;
    always @* case (x_at[3:0])
        0: condition = 1;
        1: condition = zero;
        2: condition = !zero;
        3: condition = has_carry;
        4: condition = !has_carry;
        5: condition = has_carry != sign_b;                         // phase + velocity carries or borrows
        6: condition = has_carry == sign_b;
        7: condition = sign_a == sign_b ? !has_carry : sign_a;      // less, signed
        8: condition = sign_b;
        9: condition = sign_a == sign_b && sum[15] != sign_a;   // a signed sum leaves its bits
        10: condition = may_tick;
        11: condition = is_late;
        12: condition = asks_show;
        13: condition = touched;
        default: condition = is_last_motor;
    endcase
    reg [49:0] links;           // where calls return to, five of them
    reg [9:0] x_next;
    wire jumps = runs && x_op == JUMP;
    always @(posedge clk) begin
        takes <= jumps && condition;
        target <= x_kind == RETURN ? links[9:0] : x_number[9:0];
        if (advances) x_next <= pc;
        if (jumps && x_kind == CALL) links <= {links[39:0], x_next};
        if (jumps && x_kind == RETURN) links <= links >> 10;
    end

    // Functions.
    reg x_does;
    wire does = x_does && !takes;
    initial x_does = 0;
    always @(posedge clk) x_does <= is_ins && !takes && !waits && op == FUNCTION;
    wire [3:0] function_of = x_number[3:0];
    assign take = does && function_of == 0;
    wire rest = does && function_of == 14;
    wire shown = does && function_of == 3;
    assign step_forward = does && function_of == 7;
    assign step_backward = does && function_of == 8;
    assign set_levels = does && function_of == 9;
    assign set_enable = does && function_of == 10;
    assign set_times = does && function_of == 11;
    assign set_analog = does && function_of == 12;
    assign untouch = does && function_of == 13;
    assign busy = is_tick || !is_between;
    assign may_write = is_between && !is_tick;
    assign shows = asks_show || is_shown;
    initial {takes, target, links, x_next, may_tick, is_last_motor, touched, ticks, asks_show, is_shown} = 0;
    initial {overruns, is_late} = 0;
    initial {is_between, motor, pointer, carry, w_carry, w_adds, w_inverts, sign_a, sign_b, zero} = 0;
    initial {x_adds, x_inverts, x_is_number, x_is_logical, x_writes} = 0;
    initial {w_writes, w_loads, v_loads, w_at, v_at, w_first, w_judges, sum, bits} = 0;
    always @(posedge clk) begin
        ticks <= ticks + {3'd0, tick} - {3'd0, take};
        may_tick <= is_tick && !take && !host_writes;
        overruns <= (tick && is_tick) || (overruns && !take);
        if (take) is_late <= overruns;
        is_last_motor <= {{(32 - MOTOR_BITS){1'b0}}, motor} == MOTORS - 1;
        touched <= is_touched[motor];
        if (take) is_between <= 0;
        else if (rest) is_between <= 1;
        asks_show <= show || (asks_show && !shown);
        if (shown) is_shown <= 1;
        else if (rest) is_shown <= 0;
        if (does) case (function_of)
            0, 2: motor <= 0;
            1: motor <= motor + 1'b1;
            3: motor <= show_motor;
            4: pointer <= {1'b0, a[7:0], 4'd0};
            5: pointer <= {4'd0, a[4:0], 4'd0};
            6: pointer <= {3'd0, a[7:0], 2'd0};
            default: ;
        endcase
    end

    `include "rtl/motors/motors_program.vh"
endmodule
