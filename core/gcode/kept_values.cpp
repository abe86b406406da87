#include "core/gcode/kept_values.hpp"

namespace lockstep::gcode {
namespace {

constexpr std::size_t rotation_parameter(std::size_t system) {
    return static_cast<std::size_t>(origin_parameter(system)) + kAxes;
}

std::optional<Point> unless(const Point& usual, const Point& place) {
    return place == usual ? std::nullopt : std::optional(place);
}

template <typename Value>
void take_change(const Value& before, const Value& left, Value& now) {
    if (left != before) { now = left; }
}

}  // namespace

void set_kept_values(State& state, const KeptValues& values, const Point& park) {
    ParameterValues& parameters = state.parameters;
    for (std::size_t i = 0; i < kSystems; ++i) {
        set_place(parameters, origin_parameter(i), values.systems[i].origin);
        parameters.numbered[rotation_parameter(i)] = values.systems[i].rotation;
    }
    set_place(parameters, kG92Parameter, values.g92);
    parameters.numbered[kG92UsedParameter] = values.g92_applies ? 1 : 0;
    set_place(parameters, kHomeParameter, values.home.value_or(park));
    set_place(parameters, kSecondHomeParameter, values.second_home.value_or(park));
    state.tools = values.tools;
}

KeptValues kept_values(const State& state, const Point& park) {
    const ParameterValues& parameters = state.parameters;
    KeptValues values;
    for (std::size_t i = 0; i < kSystems; ++i) {
        values.systems[i] = {place_of(parameters, origin_parameter(i)), parameters.numbered[rotation_parameter(i)]};
    }
    values.g92 = place_of(parameters, kG92Parameter);
    values.g92_applies = parameters.numbered[kG92UsedParameter] != 0 && values.g92 != Point{};
    values.home = unless(park, place_of(parameters, kHomeParameter));
    values.second_home = unless(park, place_of(parameters, kSecondHomeParameter));
    values.tools = state.tools;
    return values;
}

KeptValues merged(const KeptValues& before, const KeptValues& left, KeptValues now) {
    for (std::size_t i = 0; i < kSystems; ++i) { take_change(before.systems[i], left.systems[i], now.systems[i]); }
    if (left.g92 != before.g92 || left.g92_applies != before.g92_applies) {
        now.g92 = left.g92;
        now.g92_applies = left.g92_applies;
    }
    take_change(before.home, left.home, now.home);
    take_change(before.second_home, left.second_home, now.second_home);
    for (const auto& [number, tool] : before.tools) {
        if (!left.tools.contains(number)) { now.tools.erase(number); }
    }
    for (const auto& [number, tool] : left.tools) {
        const auto known = before.tools.find(number);
        if (known == before.tools.end() || known->second != tool) { now.tools.insert_or_assign(number, tool); }
    }
    return now;
}

}  // namespace lockstep::gcode
