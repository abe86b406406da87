// The small machine in virtual time, with a flight recorder in every process, and their incident files.
#pragma once

#include <deque>
#include <memory>

#include "clients/incident/cause.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {

/// The notes of one process from its start to its end.
struct VirtualFlight : FlightLog {
    explicit VirtualFlight(std::size_t of) : process(of) {}
    void add(const FlightEvent& event) override { events.push_back({events.size() + 1, event}); }
    void set_note(std::string_view text) override { note = text; }
    std::size_t process;
    std::vector<NumberedEvent> events;
    std::string note;
};
using VirtualFlights = std::shared_ptr<std::deque<VirtualFlight>>;

inline VirtualOptions with_flights(const VirtualFlights& flights,
                                   VirtualOptions options = {.machine = small_machine()}) {
    options.flight = [flights](std::size_t process) -> FlightLog& { return flights->emplace_back(process); };
    return options;
}

/// Axes X (process 0) and Y (1), the coordinator (2). Slots of 1 ms, s = 1.
class FlownMachine : public Rig {
protected:
    using Kind = VirtualFault::Kind;
    static constexpr std::size_t kX = 0;
    static constexpr std::size_t kY = 1;
    static constexpr std::size_t kCoordinator = 2;

    FlownMachine() : FlownMachine(std::make_shared<std::deque<VirtualFlight>>()) {}
    explicit FlownMachine(const VirtualFlights& made) : Rig(with_flights(made)), flights(made) {}

    void start_job() {
        home();
        ASSERT_EQ(run(program_of({{85, 45}, {20, 60}}, 40)).status, ReplyStatus::Accepted);
        wait(0.8);
    }
    void inject(VirtualFault fault) {
        fault.at = vm.now();
        vm.schedule(fault);
    }
    static Ticks seconds(double s) { return {static_cast<std::int64_t>(s * 1e6)}; }

    /// The first incident that a process noted.
    static const NumberedEvent* incident_in(const VirtualFlight& flight) {
        for (const NumberedEvent& event : flight.events) {
            if (event.event.kind == FlightKind::Incident) { return &event; }
        }
        return nullptr;
    }
    bool any_incident() const {
        return std::ranges::any_of(*flights, [](const VirtualFlight& f) { return incident_in(f) != nullptr; });
    }
    /// The files of every process that had an incident or was replaced by a successor.
    std::vector<incident::FlightFile> files() const {
        std::vector<incident::FlightFile> files;
        for (std::size_t i = 0; i < flights->size(); ++i) {
            const VirtualFlight& flight = (*flights)[i];
            const bool ended = std::any_of(flights->begin() + static_cast<std::ptrdiff_t>(i) + 1, flights->end(),
                                           [&](const VirtualFlight& later) { return later.process == flight.process; });
            const NumberedEvent* mark = ended ? &flight.events.back() : incident_in(flight);
            if (mark == nullptr) { continue; }
            const auto reason = ended ? IncidentReason::Ended : static_cast<IncidentReason>(mark->event.detail);
            const std::string axis = flight.process < 2 ? vm.machine().axes[flight.process].name : "";
            incident::FlightFile file{.path = "flight-" + std::to_string(i),
                                      .head = {},
                                      .machine = vm.machine(),
                                      .events = flight.events,
                                      .note = flight.note,
                                      .damages = {}};
            file.head.source = {
                .machine = "rig", .process = flight_process(axis), .incarnation = i, .config = {}, .directory = {}};
            file.head.mark = {reason, mark->event.tick, 1};
            files.push_back(std::move(file));
        }
        return files;
    }
    incident::Evaluation evaluation() const {
        const auto incidents = incident::incidents_of(files());
        EXPECT_FALSE(incidents.empty());
        return incidents.empty() ? incident::Evaluation{} : incident::evaluate(incidents.back());
    }

    VirtualFlights flights;
};

}  // namespace lockstep
