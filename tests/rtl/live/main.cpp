// lockstep-fpga-verilated: serves the device in Verilog, as Verilator translates it.
#include "services/fpga/fpga_service.hpp"
#include "tests/rtl/live/verilated_device.hpp"

namespace {

std::unique_ptr<lockstep::ServedDevice> make_verilated(const lockstep::PowerUp& up) {
    return std::make_unique<lockstep::rtl::VerilatedDevice>(up);
}

}  // namespace

int main(int argc, char** argv) {
    return lockstep::run_fpga_command(
        argc, argv,
        "Runs the Verilog of sim_fpga/rtl/axis as the device of one axis in real time, on shared memory, until SIGTERM "
        "or SIGINT.",
        make_verilated);
}
