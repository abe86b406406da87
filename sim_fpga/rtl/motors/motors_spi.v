// The host's link to the devices: SPI in mode 0, with at least 8 clocks for a bit, the highest bit first.
//
// A transaction begins when select_n falls. The host sends a command of 24 bits, and then:
//   read     8 bits without meaning, while the first word is fetched; then it receives words
//   write    words
//   show     nothing more: the chip shows the words of this motor (motors_device.v)
// A command is {kind of 2 bits, motor of 5 bits, address of 17 bits}; the address counts words of 64 bits in the map of
// the motor. Behind the command and behind each word are 16 bits with its CRC (polynomial 0x1021, begins with 0xffff).
// Each word belongs to the address behind the one before it. A transaction ends when select_n rises.
//
// While the host sends the command, it receives 8 bits and their complement: {busy, refused, how many words the last
// command has written}. While the chip is busy, it accepts no command. A word with a wrong CRC, and one that comes
// while the one before it still waits for the end of a tick, are refused, and so is all behind them. A wrong command is
// refused, too: if it is to read, the host receives ones, whose CRC is wrong.
module motors_spi #(
    parameter MOTORS = 8,
    parameter MOTOR_BITS = 3
) (
    input clk,
    input select_n,
    input sck,
    input mosi,
    output miso,
    // The devices, as in motors_host.v.
    output reg write,
    output reg read,
    output reg [MOTOR_BITS-1:0] host_motor,
    output [19:1] host_address,
    output reg [63:0] write_data,
    input written,
    input was_read,
    input [15:0] read_data,
    output reg show,
    input shows
);
    localparam [1:0] READ = 1, WRITE = 2, SHOW = 3;
    localparam [2:0] COMMAND = 0, PAUSE = 1, READING = 2, WRITING = 3, DEAF = 4;

    // The pins belong to no clock, so they have two registers each. A bit is read, and the next one is sent, when sck
    // has risen: the host has read it then.
    reg [2:0] clocks;
    reg [1:0] selects, bits;
    wire is_off = selects[1];
    wire rises = !is_off && clocks[2:1] == 2'b01;

    reg [2:0] state;
    reg [6:0] count;            // bits of this command or word
    reg [62:0] received;
    reg [15:0] sent, crc, fetched;
    reg has_fetched, refused;
    reg [5:0] words;            // written since the command
    reg [16:0] word_address;
    reg [1:0] limb;             // to read; a write begins with 0
    assign miso = sent[15];
    assign host_address = {word_address, limb};
    wire next = state == READING ? miso : bits[1];
    wire [15:0] next_crc = {crc[14:0], 1'b0} ^ (crc[15] != next ? 16'h1021 : 16'd0);
    reg busy;                   // a clock later
    wire [7:0] status = {busy, refused, words};

    // A command, or a word to write, is judged in the clock behind that of its last bit, and taken in the next one.
    reg arrived, judged, is_right, accepts;
    wire [1:0] kind = received[39:38];
    wire [4:0] motor = received[37:33];
    // A limb of a word that is read begins with the next bit.
    wire begins_limb = (state == PAUSE && count == 7) ||
        (state == READING && (count == 15 || count == 31 || count == 47 || count == 79));

    initial {clocks, bits, state, count, received, sent, fetched, has_fetched, refused, words, busy} = 0;
    initial {arrived, judged, is_right, accepts} = 0;
    initial {selects, crc} = {2'b11, 16'hffff};
    initial {word_address, limb, write, read, host_motor, write_data, show} = 0;
    always @(posedge clk) begin
        {clocks, selects, bits} <= {clocks[1:0], sck, selects[0], select_n, bits[0], mosi};
        {show, arrived, judged} <= {2'd0, arrived};
        busy <= shows || show || write;
        is_right <= crc == 0;
        accepts <= crc == 0 && !busy && kind != 0 && {27'd0, motor} < MOTORS;
        if (write && written) begin
            write <= 0;
            words <= words + 1'b1;
            word_address <= word_address + 1'b1;
        end
        if (read && was_read) begin
            {read, has_fetched, fetched} <= {2'b01, read_data};
            limb <= limb - 1'b1;
            if (limb == 0) word_address <= word_address + 1'b1;
        end
        if (is_off) begin
            {state, count, crc, arrived, judged} <= {COMMAND, 7'd0, 16'hffff, 2'd0};
            sent <= {status, ~status};
            read <= 0;
        end else if (rises) begin
            received <= {received[61:0], next};
            sent <= {sent[14:0], 1'b1};
            crc <= next_crc;
            count <= count + 1'b1;
            if (begins_limb && has_fetched) {read, has_fetched, sent} <= {2'b10, fetched};
            else if (begins_limb) state <= DEAF;
            case (state)
                COMMAND: arrived <= count == 39;
                PAUSE: if (count == 7) begin
                    {count, crc} <= {7'd0, 16'hffff};
                    if (has_fetched) state <= READING;
                end
                READING: begin
                    if (count == 63) sent <= next_crc;
                    if (count == 79) {count, crc} <= {7'd0, 16'hffff};
                end
                WRITING: begin
                    if (count == 63 && write) {state, refused} <= {DEAF, 1'b1};
                    else if (count == 63) write_data <= {received, next};
                    arrived <= count == 79;
                end
                default: ;
            endcase
        end else if (judged) begin
            {count, crc} <= {7'd0, 16'hffff};
            if (state == WRITING) begin
                if (is_right) write <= 1;
                else {state, refused} <= {DEAF, 1'b1};
            end else begin
                state <= !accepts ? DEAF : kind == READ ? PAUSE : kind == WRITE ? WRITING : DEAF;
                refused <= !accepts;
                if (accepts) begin
                    words <= 0;
                    host_motor <= motor[MOTOR_BITS-1:0];
                    word_address <= received[32:16];
                    limb <= kind == READ ? 2'd3 : 2'd0;
                    read <= kind == READ;
                    has_fetched <= 0;
                    show <= kind == SHOW;
                end
            end
        end
    end
`ifdef PROOF
`include "motors_spi_properties.vh"
`endif
endmodule
