    // What motors_spi.v promises, for any bits of a host at any times. tests/rtl/proof/prove_spi proves it.
    //
    // The bits since select_n fell, the word and the remainder of its CRC are taken here once more.
    reg [6:0] at;               // bits of this command or word
    reg [15:0] remainder;
    reg [39:0] command;
    reg [63:0] word;
    reg may_write, may_show;    // this transaction's command is one to write, or to show, and right
    reg ends, ended;            // a command or word is whole since the clock before, and the one before that
    reg was_write, was_off;
    reg [63:0] was_data;
    initial {at, command, word, may_write, may_show, ends, ended, was_write, was_off, was_data} = 0;
    initial remainder = 16'hffff;
    wire [15:0] divided = {remainder[14:0], 1'b0} ^ ((remainder[15] ^ bits[1]) ? 16'h1021 : 16'd0);
    always @(posedge clk) begin
        {was_write, was_off, was_data} <= {write, is_off, write_data};
        {ends, ended} <= is_off ? 2'd0 : {rises && at == (may_write ? 79 : 39), ends};
        if (is_off) {at, remainder, may_write, may_show} <= {7'd0, 16'hffff, 2'd0};
        else if (rises) begin
            {at, remainder} <= {at + 7'd1, divided};
            if (!may_write) command <= {command[38:0], bits[1]};
            if (at < 64) word <= {word[62:0], bits[1]};
        end else if (ended) begin
            {at, remainder} <= {7'd0, 16'hffff};
            may_write <= remainder == 0 && (may_write || (!may_show && command[39:38] == WRITE));
            may_show <= remainder == 0 && !may_write && command[39:38] == SHOW;
        end
    end

    always @* begin
        // A word reaches the devices as the host sent it, and only if its command and itself have right CRCs. So
        // a read writes nothing, and what is damaged does not arrive.
        if (write && !was_write) assert (may_write && write_data == word);
        if (write && was_write) assert (write_data == was_data);
        if (show) assert (may_show);
        // A transaction ends with select_n: the next one begins with its command.
        if (is_off && was_off) assert (state == COMMAND && count == 0 && crc == 16'hffff && !read);
    end

    // What the induction needs: both have the same bits.
    wire [63:0] bits_here = (64'd1 << count) - 1'b1;
    always @* begin
        if (state == COMMAND || state == WRITING)
            assert (at == count && remainder == crc && ends == arrived && ended == judged && !may_show);
        if (state == COMMAND) assert (!may_write && ((received[39:0] ^ command) & bits_here[39:0]) == 0);
        if (state == COMMAND && (arrived || judged)) assert (count == 40);
        if (state == WRITING) assert (may_write);
        if (state == WRITING && count < 64) assert ((({1'b0, received} ^ word) & bits_here) == 0);
        if (state == WRITING && count > 63) assert (write_data == word && !write);
        if (state == WRITING && (arrived || judged)) assert (count == 80);
        if (arrived) assert (clocks[2] && !judged);
        if (judged) assert (is_right == (crc == 0));
        if (judged && accepts) assert (is_right);
    end
