#include "core/methods/methods.hpp"

#include <algorithm>
#include <array>

#include "core/methods/carrica.hpp"
#include "core/methods/carrica_off_line.hpp"
#include "core/methods/lai.hpp"
#include "core/methods/lam.hpp"
#include "core/methods/ranade.hpp"
#include "core/methods/spielauer.hpp"
#include "core/motion/step_source.hpp"

namespace lockstep::methods {
namespace {

constexpr std::array kMethods{
    Method{name_of(StepMethod::Ranade), "P. Ranade, Linear motor control without the math", Crossing::Half,
           [](const StepMove& move, Fit fit) { return ranade(move, fit); }},
    Method{name_of(StepMethod::Spielauer), "T. Spielauer, Linear stepper motor control - A summary", Crossing::Whole,
           [](const StepMove& move, Fit fit) { return spielauer(move, fit); }},
    Method{name_of(StepMethod::Lai),
           "C.-K. Lai, W.-N. Chien, Y.-T. Tsao, An FPGA-Based Multiple-Axis Velocity Controller", Crossing::Whole,
           [](const StepMove& move, Fit fit) { return lai(move, fit); }},
    Method{name_of(StepMethod::Lam),
           "C. Y. Lam, P. Ehkan, Design and Implementation of FPGA Based Bipolar Stepper Motor Controller",
           Crossing::Whole, [](const StepMove& move, Fit fit) { return lam(move, fit); }},
    Method{name_of(StepMethod::Carrica),
           "D. Carrica, M. A. Funes, S. A. González, Novel stepper motor controller based on FPGA", Crossing::Whole,
           [](const StepMove& move, Fit fit) { return carrica(move, fit); }},
    Method{"off-line", "the stored table that D. Carrica et al. compare with", Crossing::Whole,
           [](const StepMove& move, Fit fit) { return carrica_off_line(move, fit); }},
};

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method* find_method(std::string_view name) {
    const auto* const found = std::ranges::find(kMethods, name, &Method::name);
    return found == kMethods.end() ? nullptr : found;
}

}  // namespace lockstep::methods
