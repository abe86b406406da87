#include "services/flight/flight_recorder.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "services/documents/machine_file.hpp"
#include "services/files/directories.hpp"
#include "services/flight/incident_file.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/log.hpp"
#include "services/runtime/real_time.hpp"
#include "services/runtime/sleep.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr auto kLookEvery = 100ms;
constexpr auto kAftermath = 1s;    // wait after the last of several close incidents ...
constexpr auto kLongestWait = 5s;  // ... but at most this long after the first

/// The log of a process that keeps no notes.
class NoFlight final : public FlightLog {
public:
    void add(const FlightEvent& /*event*/) override {}
    void set_note(std::string_view /*text*/) override {}
};

std::string how_to_read(const std::filesystem::path& file) {
    return file.string() + "; see: lockstep analyze --incident " + file.parent_path().string();
}

void say_left(const LeftRings& left) {
    for (const auto& file : left.saved) {
        log_warning("a process of this machine ended unexpectedly; its notes are in " + how_to_read(file));
    }
    for (const std::string& problem : left.problems) { log_warning(problem); }
}

}  // namespace

std::expected<std::unique_ptr<FlightRecorder>, std::string> FlightRecorder::open(const std::filesystem::path& directory,
                                                                                 const FlightSource& source,
                                                                                 std::size_t events) {
    auto ring = FlightRing::create(directory, source, events);
    if (!ring) { return std::unexpected(ring.error()); }
    return std::unique_ptr<FlightRecorder>(new FlightRecorder(std::move(*ring), directory, source));
}

FlightRecorder::FlightRecorder(FlightRing ring, std::filesystem::path directory, FlightSource source)
    : ring_(std::move(ring)), directory_(std::move(directory)), source_(std::move(source)) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

FlightRecorder::~FlightRecorder() {
    thread_.request_stop();
    thread_.join();
}

void FlightRecorder::add(const FlightEvent& event) {
    ring_.add(event);
    if (event.kind == FlightKind::Incident) { incidents_.fetch_add(1, std::memory_order_release); }
}

void FlightRecorder::serve(const std::stop_token& stop) {
    leave_real_time();
    say_left(save_left_rings(directory_, source_.directory));
    std::uint64_t seen = 0;
    bool has_seen = false;
    std::chrono::nanoseconds first{};
    std::chrono::nanoseconds last{};
    for (bool goes_on = true; goes_on;) {
        goes_on = sleep_unless(stop, kLookEvery);
        const std::chrono::nanoseconds now = monotonic_now();
        const std::uint64_t noted = incidents_.load(std::memory_order_acquire);
        if (noted != seen) { last = now; }
        if (noted != seen && !has_seen) { first = now; }
        has_seen = has_seen || noted != seen;
        seen = noted;
        if (!has_seen || (goes_on && now - last < kAftermath && now - first < kLongestWait)) { continue; }
        write();
        has_seen = false;
    }
}

void FlightRecorder::write() {
    const auto snapshot = read_ring(ring_.path());
    if (!snapshot) { return log_warning("the incident file cannot be written: " + snapshot.error()); }
    const auto incident = first_incident(snapshot->events, written_);
    if (!incident) { return; }
    written_ = snapshot->events.back().number;
    const auto reason = static_cast<IncidentReason>(incident->event.detail);
    const auto file = write_incident(*snapshot, {reason, incident->event.tick, wall_clock_us()});
    if (!file) { return log_warning("the incident file cannot be written: " + file.error()); }
    log_warning(
        fmt::format("incident ({}): the notes of the time before it are in {}", name_of(reason), how_to_read(*file)));
}

std::unique_ptr<FlightLog> open_flight(const MachineSetup& machine, const std::string& axis, Identity identity) {
    const FlightConfig& config = machine.record.flight;
    if (!config.kept) { return std::make_unique<NoFlight>(); }
    const FlightSource source{.machine = machine.name,
                              .process = flight_process(axis),
                              .incarnation = identity,
                              .tick_ns = machine.tick_ns,
                              .config = machine_text(machine),
                              .directory = incident_directory(machine),
                              .files = config.files};
    const auto events = static_cast<std::size_t>(config.memory_kb) * 1024 / kFlightSlotBytes;
    auto recorder = FlightRecorder::open(memory_directory(), source, events);
    if (recorder) { return std::move(*recorder); }
    log_warning("no flight recorder is kept: " + recorder.error());
    return std::make_unique<NoFlight>();
}

LeftRings save_left_rings(const std::filesystem::path& rings, const std::filesystem::path& incidents) {
    LeftRings found;
    for (const auto& path : rings_in(rings)) {
        auto left = LeftRing::claim(path);
        const auto snapshot = left ? read_ring(path) : std::unexpected(std::string());
        if (!snapshot || snapshot->source.directory != incidents) { continue; }
        const Tick last = snapshot->events.empty() ? Tick{} : snapshot->events.back().event.tick;
        const auto file = write_incident(*snapshot, {IncidentReason::Ended, last, wall_clock_us()});
        if (file) {
            left->remove();
            found.saved.push_back(*file);
        } else {
            found.problems.push_back(fmt::format("the notes of {} before its end cannot be written: {}",
                                                 snapshot->source.process, file.error()));
        }
    }
    return found;
}

}  // namespace lockstep
