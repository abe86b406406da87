#include "sim_fpga/contacts/work_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep {

WorkContacts::WorkContacts(const MachineConfig& machine, const std::string& motor)
    : kinematics_(machine), work_(machine.workpiece.value_or(WorkpieceConfig{})) {
    if (!machine.workpiece) { return; }
    for (const char* name : {"X", "Y", "Z"}) { axes_.push_back(machine.axis_named(name).value()); }
    for (const AxisConfig& axis : machine.axes) { step_mm_.push_back(1 / axis.steps_per_mm); }
    for (const AxisIndex axis : axes_) {
        reach_ = reach_.with(Reach::of(machine.axes[axis], machine));
        rounded_mm_ = std::max(rounded_mm_, 2 * step_mm_[axis]);
    }
    for (std::size_t i = 0; i < machine.inputs.size(); ++i) {
        const InputConfig& input = machine.inputs[i];
        if (input.use != InputUse::Probe || (!motor.empty() && input.motor != motor)) { continue; }
        contacts_.push_back({.input = i, .probe = input.number.value_or(0)});
    }
}

WorkPlace WorkContacts::place_of(std::span<const Position> slides) const {
    const auto mm = [&](AxisIndex axis) { return kinematics_.axis_steps(axis, slides) * step_mm_[axis]; };
    return {mm(axes_[0]), mm(axes_[1]), mm(axes_[2])};
}

void WorkContacts::follow(std::span<const Position> slides, const std::function<void(std::size_t, bool)>& set) {
    if (contacts_.empty()) { return; }
    place_ = place_of(slides);
    for (Contact& contact : contacts_) {
        contact.gap_mm = work_.gap_mm(contact.probe, place_);
        const bool is_closed = contact.gap_mm <= 0;
        if (is_closed != contact.is_closed) { set(contact.input, is_closed); }
        contact.is_closed = is_closed;
    }
}

bool WorkContacts::may_change_within(Ticks next) {
    const Ticks last = std::exchange(interval_, next);
    const WorkPlace begun = std::exchange(begun_at_, place_);
    const double way = std::hypot(place_.x_mm - begun.x_mm, place_.y_mm - begun.y_mm, place_.z_mm - begun.z_mm);
    const double reach_mm = reach_.mm(way, last, next) + rounded_mm_;
    return std::ranges::any_of(contacts_, [&](const Contact& contact) { return std::abs(contact.gap_mm) <= reach_mm; });
}

}  // namespace lockstep
