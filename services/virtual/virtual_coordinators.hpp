// The coordinators of a virtual machine, each with its flight recorder. A coordinator is empty while no process runs.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "core/flight/coordinator_flight.hpp"

namespace lockstep {

class VirtualCoordinators {
public:
    VirtualCoordinators(const MachineConfig& machine, std::size_t count, OnTakeover on_takeover, MakeRows make_rows)
        : machine_(machine), on_takeover_(on_takeover), make_rows_(std::move(make_rows)), processes_(count) {}

    /// `flight`: null if it notes nothing.
    void start(std::size_t number, Identity identity, std::uint64_t config_hash, FlightLog* flight);
    void end(std::size_t number) { processes_[number].coordinator.reset(); }
    CoordinatorOutputs step(std::size_t number, const CoordinatorInputs& in);
    /// Gives every running coordinator a complete program.
    void give_program(std::uint64_t id, const Program& program);
    /// The one that owns the machine. If several claim it, the one with the highest term.
    std::optional<std::size_t> owner() const;

private:
    struct Process {
        std::optional<Coordinator> coordinator;
        std::optional<CoordinatorFlight> flight;
    };
    MachineConfig machine_;
    OnTakeover on_takeover_;
    MakeRows make_rows_;
    std::vector<Process> processes_;
};

}  // namespace lockstep
