#include "services/fpga/pushed_slide.hpp"

#include <fstream>
#include <string>
#include <utility>

namespace lockstep {

PushedSlide::PushedSlide(const MotorConfig& motor, std::filesystem::path file)
    : motor_(motor), file_(std::move(file)) {}

void PushedSlide::apply_to(Plant& plant) {
    if (file_.empty() || loops_++ % kLoopsPerRead != 0) { return; }
    std::ifstream text(file_);
    std::string name;
    for (double mm = 0; text >> name >> mm;) {
        if (name != motor_.name) { continue; }
        const std::int64_t steps = to_steps(motor_, mm);
        plant.push(steps - pushed_);
        pushed_ = steps;
    }
}

}  // namespace lockstep
