// The flight recorder of a process: a ring of its notes, and a thread that writes them to a file a second after an
// incident, so that the file includes the aftermath.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "services/flight/flight_ring.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

class FlightRecorder final : public FlightLog {
public:
    /// `directory` holds the rings. Error: why the ring's memory cannot be created.
    static std::expected<std::unique_ptr<FlightRecorder>, std::string> open(const std::filesystem::path& directory,
                                                                            const FlightSource& source,
                                                                            std::size_t events);
    /// Writes an incident that is not yet written.
    ~FlightRecorder() override;

    void add(const FlightEvent& event) override;
    void set_note(std::string_view text) override { ring_.set_note(text); }

private:
    FlightRecorder(FlightRing ring, std::filesystem::path directory, FlightSource source);
    void serve(const std::stop_token& stop);
    void write();

    FlightRing ring_;
    std::filesystem::path directory_;
    FlightSource source_;
    std::atomic<std::uint64_t> incidents_ = 0;  // number noted so far
    std::uint64_t written_ = 0;                 // used by the thread: number of the last event in a file
    std::jthread thread_;
};

/// Opens the flight recorder of a process as the machine's file configures it. `axis` is empty for the coordinator. If
/// that fails, it logs the reason and the process keeps no notes.
std::unique_ptr<FlightLog> open_flight(const MachineSetup& machine, const std::string& axis, Identity identity);

/// The result of saving the rings of dead processes.
struct LeftRings {
    std::vector<std::filesystem::path> saved;
    std::vector<std::string> problems;  // which rings could not be written, and why
};

/// Saves the rings of dead processes in `rings`, if `incidents` is the directory of their incident files.
LeftRings save_left_rings(const std::filesystem::path& rings, const std::filesystem::path& incidents);

}  // namespace lockstep
