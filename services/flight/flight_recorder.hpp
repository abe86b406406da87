// The flight recorder of a process: a ring of its notes, and a thread that writes them to a file at an incident, and
// again soon after, so that the file includes the aftermath.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/machine.hpp"
#include "services/flight/flight_ring.hpp"

namespace lockstep {

class FlightRecorder final : public FlightLog {
public:
    /// `directory`: for the rings. Error: why there is no memory for it.
    static std::expected<std::unique_ptr<FlightRecorder>, std::string> open(const std::filesystem::path& directory,
                                                                            const FlightSource& source,
                                                                            std::size_t events);
    /// Writes what is not yet written of an incident.
    ~FlightRecorder() override;

    void add(const FlightEvent& event) override;
    void set_note(std::string_view text) override { ring_.set_note(text); }

private:
    FlightRecorder(FlightRing ring, std::filesystem::path directory, FlightSource source);
    void serve(const std::stop_token& stop);
    bool sleep(const std::stop_token& stop);
    void write();

    FlightRing ring_;
    std::filesystem::path directory_;
    FlightSource source_;
    std::atomic<std::uint64_t> incidents_ = 0;  // noted so far
    std::uint64_t written_ = 0;                 // the thread's: the number of the last event that is in a file
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::jthread thread_;
};

/// Opens the flight recorder of a process as the machine's file configures it; `axis` is empty for the coordinator. If
/// that fails, the log states why, and nothing is kept.
std::unique_ptr<FlightLog> open_flight(const MachineConfig& machine, const std::string& axis, Identity identity);

/// The notes of dead processes, now in files.
struct LeftRings {
    std::vector<std::filesystem::path> saved;
    std::vector<std::string> problems;  // the rings that could not be written, and why
};

/// Saves those rings in `rings` whose incident files belong in `incidents`.
LeftRings save_left_rings(const std::filesystem::path& rings, const std::filesystem::path& incidents);

}  // namespace lockstep
