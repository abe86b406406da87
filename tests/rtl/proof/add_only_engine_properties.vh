    // What add_only_engine.v promises, for motor PROVED. tests/rtl/proof/prove proves it, for all times and hosts.
    //
    // The definition: in each tick in which the motor has a piece, velocity += acceleration and phase += velocity,
    // numbers of 2 * LIMB bits. The carry is a step forward, the borrow one backward. A piece lasts as many ticks as
    // the host wrote.
    localparam BITS = 2 * LIMB;
    reg [LIMB-1:0] left[0:1];
    reg [BITS-1:0] velocity[0:1], acceleration[0:1];
    reg [BITS-1:0] phase;
    reg [1:0] has;             // which banks are full
    reg current;               // the bank that runs, or the next one to run
    reg runs;                  // in this tick
    reg forward_soon, backward_soon, forward_now, backward_now; // of this tick, and of the tick before
    initial begin
        {left[0], left[1], velocity[0], velocity[1], acceleration[0], acceleration[1]} = 0;
        phase = 1 << (BITS - 1);
        {has, current, runs, forward_soon, backward_soon, forward_now, backward_now} = 0;
    end

    // The host writes only into a bank that is not full, and marks only such a bank.
    wire [MOTOR_BITS-1:0] addressed = write_address[MOTOR_BITS+3:4];
    always @* begin
        if (write) assume (addressed <= LAST_MOTOR && write_address[3:1] < 6 && write_address[3:1] != 3);
        if (write) assume (!banks_full[{addressed, write_address[0]}]);
        if (mark) assume (mark_motor <= LAST_MOTOR && !banks_full[{mark_motor, mark_bank}]);
    end

    wire [BITS-1:0] faster = velocity[current] + acceleration[current];
    wire [BITS:0] further = {1'b0, phase} + {1'b0, faster};
    wire ours = motor == `PROVED;
    always @(posedge clk) begin
        if (slot == HOST && following == `PROVED) runs <= has[current];
        if (slot == 1 && ours) begin
            {forward_now, backward_now} <= {forward_soon, backward_soon};
            forward_soon <= runs && !faster[BITS-1] && further[BITS];
            backward_soon <= runs && faster[BITS-1] && !further[BITS];
            if (runs) begin
                velocity[current] <= faster;
                phase <= further[BITS-1:0];
                left[current] <= left[current] - 1'b1;
                if (left[current] == 1) begin
                    has[current] <= 0;
                    current <= !current;
                end
            end
        end
        if (written && addressed == `PROVED) case (write_address[3:1])
            0: left[write_address[0]] <= write_data;
            1: velocity[write_address[0]][LIMB-1:0] <= write_data;
            2: velocity[write_address[0]][BITS-1:LIMB] <= write_data;
            4: acceleration[write_address[0]][LIMB-1:0] <= write_data;
            default: acceleration[write_address[0]][BITS-1:LIMB] <= write_data;
        endcase
        if (mark && mark_motor == `PROVED) has[mark_bank] <= 1;
    end

    // The registers in memory are those of the definition, once in each tick.
    wire [MOTOR_BITS+2:0] words = `PROVED * 8;
    wire [MOTOR_BITS+1:0] constants = `PROVED * 4;
    integer j;
    always @* begin
        if (slot == 1 && ours) for (j = 0; j < 2; j = j + 1) begin
            assert (changing[words + j] == left[j]);
            assert ({changing[words + 4 + j], changing[words + 2 + j]} == velocity[j]);
            assert ({constant[constants + 2 + j], constant[constants + j]} == acceleration[j]);
            assert ({changing[words + 7], changing[words + 6]} == phase);
        end
        if (slot == HOST && ours) assert (banks_full[2*`PROVED+1:2*`PROVED] == has && present[`PROVED] == current);
        // The steps of a tick come together, two clocks into the next one.
        if (slot == 2 && motor == 0) begin
            assert (forward[`PROVED] == forward_now);
            assert (backward[`PROVED] == backward_now);
        end
        assert ((forward & backward) == 0); // at most one step per tick
    end
