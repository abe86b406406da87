#include "core/methods/methods.hpp"

#include <algorithm>
#include <array>

#include "core/methods/carrica.hpp"
#include "core/methods/lai/lai.hpp"
#include "core/methods/lam.hpp"
#include "core/methods/ranade.hpp"
#include "core/methods/spielauer.hpp"

namespace lockstep::stepgen {
namespace {

constexpr std::array kMethods{
    Method{"ranade", "P. Ranade, Linear motor control without the math", Crossing::Half,
           [](const StepMove& move, Fit fit) { return ranade(move, fit); }},
    Method{"spielauer", "T. Spielauer, Linear stepper motor control - A summary", Crossing::Whole,
           [](const StepMove& move, Fit fit) { return spielauer(move, fit); }},
    Method{"lai", "C.-K. Lai, W.-N. Chien, Y.-T. Tsao, An FPGA-Based Multiple-Axis Velocity Controller",
           Crossing::Whole, [](const StepMove& move, Fit fit) { return lai(move, fit); }},
    Method{"lam", "C. Y. Lam, P. Ehkan, Design and Implementation of FPGA Based Bipolar Stepper Motor Controller",
           Crossing::Whole, [](const StepMove& move, Fit fit) { return lam(move, fit); }},
    Method{"carrica", "D. Carrica, M. A. Funes, S. A. González, Novel stepper motor controller based on FPGA",
           Crossing::Whole, [](const StepMove& move, Fit fit) { return carrica(move, fit); }},
};

}  // namespace

std::span<const Method> methods() { return kMethods; }

std::string_view name_of(StepMethod method) { return kMethods[static_cast<std::size_t>(method)].name; }

const Method* find_method(std::string_view name) {
    const auto* const found = std::ranges::find(kMethods, name, &Method::name);
    return found == kMethods.end() ? nullptr : found;
}

}  // namespace lockstep::stepgen
