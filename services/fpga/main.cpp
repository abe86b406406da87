// lockstep-fpga: serves a simulated device.
#include <utility>

#include "services/fpga/fpga_service.hpp"
#include "sim_fpga/device.hpp"

namespace lockstep {
namespace {

class ServedSimulation final : public ServedDevice {
public:
    explicit ServedSimulation(const PowerUp& up) : device_(up.window, up.plant, up.tick_ns, up.now, up.number) {}

    void advance(Tick until) override { device_.advance(until); }
    bool is_intact() const override { return device_.is_intact(); }
    Plant& plant() override { return device_.plant(); }

private:
    SimulatedDevice device_;
};

std::unique_ptr<ServedDevice> make_simulation(const PowerUp& up) { return std::make_unique<ServedSimulation>(up); }

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    return lockstep::run_fpga_command(
        argc, argv, "Runs the simulated device of one axis in real time, on shared memory, until SIGTERM or SIGINT.",
        lockstep::make_simulation);
}
