// A module of sim_fpga/rtl with one clock, as Verilator translates it.
#pragma once

namespace lockstep::rtl {

/// Inputs and outputs are members of `pins`, by the names of the module's ports.
template <typename Module>
struct Clocked {
    Module pins;

    /// One period of the clock. The registers take their new values from the present inputs.
    void clock() {
        pins.clk = 0;
        pins.eval();
        pins.clk = 1;
        pins.eval();
    }
    /// One period with `reset`.
    void reset() {
        pins.reset = 1;
        clock();
        pins.reset = 0;
    }
};

}  // namespace lockstep::rtl
