#include "services/virtual/virtual_coordinators.hpp"

#include "core/methods/paper_steps.hpp"

namespace lockstep {

void VirtualCoordinators::start(std::size_t number, Identity identity, std::uint64_t config_hash, FlightLog* flight) {
    Process& it = processes_[number];
    const auto standby = processes_.size() > 1 ? std::optional(on_takeover_) : std::nullopt;
    it.coordinator.emplace(machine_, identity, config_hash, methods::begin_steps, standby, make_rows_);
    if (flight != nullptr) { it.flight.emplace(machine_, *flight); }
}

CoordinatorOutputs VirtualCoordinators::step(std::size_t number, const CoordinatorInputs& in) {
    Process& it = processes_[number];
    CoordinatorOutputs out = it.coordinator->step(in);
    if (it.flight) { it.flight->take(in, out); }
    return out;
}

void VirtualCoordinators::give_program(std::uint64_t id, const Program& program) {
    for (Process& one : processes_) {
        if (one.coordinator) { one.coordinator->programs().accept(id, program); }
    }
}

std::optional<std::size_t> VirtualCoordinators::owner() const {
    std::optional<std::size_t> owner;
    for (std::size_t i = 0; i < processes_.size(); ++i) {
        const auto& one = processes_[i].coordinator;
        const bool owns = one && one->owns_machine();
        if (owns && (!owner || one->term() > processes_[*owner].coordinator->term())) { owner = i; }
    }
    return owner;
}

}  // namespace lockstep
