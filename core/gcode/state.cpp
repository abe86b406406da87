#include "core/gcode/state.hpp"

#include <algorithm>
#include <cmath>

#include "core/gcode/text/functions.hpp"

namespace lockstep::gcode {
namespace {

void rotate(Point& point, double degrees) {
    if (degrees == 0) { return; }
    const double cosine = std::cos(degrees / kDegrees);
    const double sine = std::sin(degrees / kDegrees);
    const double x = point[0];
    point[0] = x * cosine - point[1] * sine;
    point[1] = x * sine + point[1] * cosine;
}

}  // namespace

Point place_of(const ParameterValues& parameters, int first) {
    Point place;
    std::copy_n(parameters.numbered.begin() + first, kAxes, place.begin());
    return place;
}

void set_place(ParameterValues& parameters, int first, const Point& place) {
    std::ranges::copy(place, parameters.numbered.begin() + first);
}

Point to_machine(const Offsets& offsets, const Point& program) {
    Point result = program;
    for (std::size_t axis = 0; axis < kAxes; ++axis) { result[axis] += offsets.g92[axis]; }
    rotate(result, offsets.rotation);
    for (std::size_t axis = 0; axis < kAxes; ++axis) { result[axis] += offsets.origin[axis] + offsets.tool[axis]; }
    return result;
}

Point to_program(const Offsets& offsets, const Point& machine) {
    Point result = machine;
    for (std::size_t axis = 0; axis < kAxes; ++axis) { result[axis] -= offsets.origin[axis] + offsets.tool[axis]; }
    rotate(result, -offsets.rotation);
    for (std::size_t axis = 0; axis < kAxes; ++axis) { result[axis] -= offsets.g92[axis]; }
    return result;
}

void begin_system(State& state, std::size_t system) {
    const int first = origin_parameter(system);
    state.modal.system = system;
    state.parameters.numbered[kSystemParameter] = static_cast<double>(system + 1);
    state.offsets.origin = place_of(state.parameters, first);
    state.offsets.rotation = state.parameters.numbered[static_cast<std::size_t>(first) + kAxes];
    state.program = to_program(state.offsets, state.machine);
}

void note_touch(State& state, const Touch& touch) {
    constexpr double kMillimetresPerInch = 25.4;
    state.machine = touch.rest;
    state.program = to_program(state.offsets, touch.rest);
    Point at = to_program(state.offsets, touch.at);
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        if (state.modal.inches && !is_turning(axis)) { at[axis] /= kMillimetresPerInch; }
    }
    set_place(state.parameters, kTouchParameter, at);
    state.parameters.numbered[kTouchedParameter] = touch.touched ? 1 : 0;
}

void begin(State& state) {
    const std::vector<double>& numbered = state.parameters.numbered;
    const double chosen = numbered[kSystemParameter];
    state.offsets.g92 = numbered[kG92UsedParameter] != 0 ? place_of(state.parameters, kG92Parameter) : Point{};
    begin_system(state, chosen >= 1 && chosen <= kSystems ? static_cast<std::size_t>(chosen) - 1 : 0);
}

}  // namespace lockstep::gcode
