// The five methods by name, and behind them the off-line table that one of their papers compares with.
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

/// Nothing where no method has that name.
const Method* find_method(std::string_view name);

}  // namespace lockstep::methods
