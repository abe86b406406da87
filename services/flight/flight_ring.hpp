// The newest events of a process, in a file in memory (/dev/shm) that it has mapped: writing is a store of 64 bytes, no
// disk is ever waited for, and when the process is killed, or stopped, all that it noted can be read all the same.
//
// The file: eight words (magic, version, events, bytes of the source, where events begin), a note of 256 bytes (empty
// unless the process ends by itself), the source, and the events, each with its number before it, which is 0 while it
// is written. One process writes; any may read at any time.
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
    /// Makes `directory`, readable by this user alone, and a ring in it. Error: why not.
    static std::expected<FlightRing, std::string> create(const std::filesystem::path& directory,
                                                         const FlightSource& source, std::size_t events);
    FlightRing(FlightRing&& other) noexcept;
    FlightRing& operator=(FlightRing&&) = delete;
    /// The process has ended as it was asked to: the ring goes.
    ~FlightRing();

    /// From any thread. Never waits, allocates nothing.
    void add(const FlightEvent& event);
    /// Why the process is about to end by itself. Safe in a process whose other state is damaged: it copies bytes into
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
    int file_;  // open for good: the lock on it says that its process lives; below 0: moved from
    SharedMapping mapping_;
    std::uint64_t* slots_;
    std::size_t events_;
    std::atomic<std::uint64_t> number_ = 0;
};

/// Error: it cannot be read, or is no ring of this version.
std::expected<FlightSnapshot, std::string> read_ring(const std::filesystem::path& path);

/// All rings there, those of dead processes too.
std::vector<std::filesystem::path> rings_in(const std::filesystem::path& directory);

/// A ring whose process has ended without taking it along: nobody else takes it for one while this object lives.
class LeftRing {
public:
    /// Nothing: its process lives, or somebody else has it.
    static std::optional<LeftRing> claim(const std::filesystem::path& path);
    LeftRing(LeftRing&& other) noexcept;
    LeftRing& operator=(LeftRing&&) = delete;
    ~LeftRing();
    /// It has been seen to.
    void remove();

private:
    LeftRing(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
    std::filesystem::path path_;
    int file_;  // below 0: moved from
};

}  // namespace lockstep
