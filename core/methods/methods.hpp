// The five methods by name, then the off-line table with which one of the papers compares its method.
#pragma once

#include <span>
#include <string_view>

#include "core/machine.hpp"
#include "core/methods/method.hpp"

namespace lockstep::methods {

struct Method {
    std::string_view name;    // "ranade"
    std::string_view source;  // author and title
    Crossing crossing;
    StepResult (*run)(const StepMove&, Fit);  // with the paper's parameters
};

std::span<const Method> methods();

/// Returns null if no method has that name.
const Method* find_method(std::string_view name);

}  // namespace lockstep::methods
