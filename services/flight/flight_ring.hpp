// Keeps the newest events of a process in a mapped memory file (/dev/shm). A write stores 64 bytes and never waits for
// a disk. After the process was killed or while it is stopped, other processes can read its notes.
//
// The file has eight words (magic, version, events, bytes of the source, where events begin), a note of 256 bytes
// (empty unless the process ends itself), the source, and the events. Each event follows its number, which is 0 during
// the write. One process writes, and any process may read at any time.
#pragma once

#include <atomic>
#include <cstddef>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/files/descriptor.hpp"
#include "services/flight/flight_source.hpp"
#include "services/runtime/shared_mapping.hpp"

namespace lockstep {

inline constexpr std::size_t kFlightSlotBytes = 64;
inline constexpr std::size_t kFlightNoteBytes = 256;

class FlightRing {
public:
    /// Creates `directory`, accessible to this user only, and a ring in it. Error: why it cannot.
    static std::expected<FlightRing, std::string> create(const std::filesystem::path& directory,
                                                         const FlightSource& source, std::size_t events);
    FlightRing(FlightRing&& other) noexcept;
    FlightRing& operator=(FlightRing&&) = delete;
    /// Removes the ring, because the process ends as requested.
    ~FlightRing();

    /// Any thread may call it. It never waits and allocates nothing.
    void add(const FlightEvent& event);
    /// Notes why the process is about to end itself. Safe even if other state of the process is damaged: it only copies
    /// at most kFlightNoteBytes into memory that is already mapped.
    void set_note(std::string_view text);
    const std::filesystem::path& path() const { return path_; }

private:
    /// `slots_at` is the byte offset of the events.
    FlightRing(std::filesystem::path path, Descriptor file, SharedMapping mapping, std::size_t slots_at,
               std::size_t events)
        : path_(std::move(path)),
          file_(std::move(file)),
          mapping_(std::move(mapping)),
          slots_(mapping_.words() + slots_at / sizeof(std::uint64_t)),
          events_(events) {}

    std::filesystem::path path_;
    Descriptor file_;  // stays open: its lock shows that the process is alive
    SharedMapping mapping_;
    std::uint64_t* slots_;
    std::size_t events_;
    std::atomic<std::uint64_t> number_ = 0;
};

/// Error: the file cannot be read or is not a ring of this version.
std::expected<FlightSnapshot, std::string> read_ring(const std::filesystem::path& path);

/// All rings in the directory, including those of dead processes.
std::vector<std::filesystem::path> rings_in(const std::filesystem::path& directory);

/// The ring of a process that ended without removing it. While this object exists, no other process claims it.
class LeftRing {
public:
    /// Returns nullopt if the ring's process is alive or another process has claimed the ring.
    static std::optional<LeftRing> claim(const std::filesystem::path& path);
    /// Removes the ring. Call it after saving it.
    void remove();

private:
    LeftRing(std::filesystem::path path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}
    std::filesystem::path path_;
    Descriptor file_;
};

}  // namespace lockstep
