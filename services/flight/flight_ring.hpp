// The newest events of a process, in a memory file (/dev/shm) that it has mapped: a write stores 64 bytes and never
// waits for a disk. When the process is killed or stopped, its notes can still be read.
//
// The file: eight words (magic, version, events, bytes of the source, where events begin), a note of 256 bytes (empty
// unless the process ends itself), the source, and the events. Each event's number precedes it, and is 0 during the
// write. One process writes; any process may read at any time.
#pragma once

#include <atomic>
#include <cstddef>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/flight/flight_source.hpp"
#include "services/runtime/shared_mapping.hpp"

namespace lockstep {

inline constexpr std::size_t kFlightSlotBytes = 64;
inline constexpr std::size_t kFlightNoteBytes = 256;

class FlightRing {
public:
    /// Creates `directory`, readable by this user alone, and a ring in it. Error: why not.
    static std::expected<FlightRing, std::string> create(const std::filesystem::path& directory,
                                                         const FlightSource& source, std::size_t events);
    FlightRing(FlightRing&& other) noexcept;
    FlightRing& operator=(FlightRing&&) = delete;
    /// Removes the ring: the process ended as requested.
    ~FlightRing();

    /// From any thread. Never waits, allocates nothing.
    void add(const FlightEvent& event);
    /// Why the process is about to end itself. Safe in a process whose other state is damaged: it copies bytes into
    /// memory that is mapped already, at most kFlightNoteBytes of them.
    void set_note(std::string_view text);
    const std::filesystem::path& path() const { return path_; }

private:
    /// slots_at: the byte where the events begin.
    FlightRing(std::filesystem::path path, int file, SharedMapping mapping, std::size_t slots_at, std::size_t events)
        : path_(std::move(path)),
          file_(file),
          mapping_(std::move(mapping)),
          slots_(mapping_.words() + slots_at / sizeof(std::uint64_t)),
          events_(events) {}

    std::filesystem::path path_;
    int file_;  // stays open: its lock shows that the process lives; below 0: moved from
    SharedMapping mapping_;
    std::uint64_t* slots_;
    std::size_t events_;
    std::atomic<std::uint64_t> number_ = 0;
};

/// Error: it cannot be read, or is not a ring of this version.
std::expected<FlightSnapshot, std::string> read_ring(const std::filesystem::path& path);

/// All rings in the directory, also those of dead processes.
std::vector<std::filesystem::path> rings_in(const std::filesystem::path& directory);

/// The ring of a process that ended without removing it. While this object exists, no other process claims it.
class LeftRing {
public:
    /// Nothing: its process lives, or another process has claimed it.
    static std::optional<LeftRing> claim(const std::filesystem::path& path);
    LeftRing(LeftRing&& other) noexcept;
    LeftRing& operator=(LeftRing&&) = delete;
    ~LeftRing();
    /// Removes the ring after it was saved.
    void remove();

private:
    LeftRing(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
    std::filesystem::path path_;
    int file_;  // below 0: moved from
};

}  // namespace lockstep
