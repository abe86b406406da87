#include "services/fpga/closed_inputs.hpp"

#include <fstream>
#include <set>
#include <utility>

namespace lockstep {

ClosedInputs::ClosedInputs(const MachineConfig& machine, const MotorConfig& motor, std::filesystem::path file)
    : file_(std::move(file)) {
    for (const InputConfig& input : machine.inputs) {
        if (input.motor == motor.name) { inputs_.push_back(input); }
    }
}

void ClosedInputs::apply_to(Plant& plant) {
    if (file_.empty() || inputs_.empty() || loops_++ % kLoopsPerRead != 0) { return; }
    std::ifstream text(file_);
    std::set<std::string> closed;
    for (std::string name; text >> name;) { closed.insert(name); }
    for (const InputConfig& input : inputs_) { set_input(plant, input, closed.contains(input.name)); }
}

}  // namespace lockstep
