#include "services/flight/flight_ring.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

#include "services/files/directories.hpp"
#include "services/files/named_file.hpp"
#include "services/flight/flight_messages.hpp"
#include "services/runtime/numbered_slot.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRingMagic = 0x4c53464c49474854U;  // LSFLIGHT
constexpr std::uint64_t kRingVersion = 2;
constexpr std::size_t kHeaderBytes = kFlightSlotBytes;
constexpr std::size_t kSourceAt = kHeaderBytes + kFlightNoteBytes;
constexpr std::size_t kMaxBytes = std::size_t{128} << 20;  // a larger file is not a ring
using EventSlot = NumberedSlot<FlightEvent>;
static_assert(EventSlot::kWords * sizeof(std::uint64_t) == kFlightSlotBytes);

struct Header {
    std::uint64_t magic = kRingMagic;
    std::uint64_t version = kRingVersion;
    std::uint64_t events = 0;
    std::uint64_t source_bytes = 0;  // after the note
    std::uint64_t slots_at = 0;      // byte offset
};

/// Never reads beyond the file, even if its header is damaged.
std::optional<Header> header_of(const SharedMapping& mapping) {
    Header header;
    if (mapping.bytes() < kSourceAt) { return std::nullopt; }
    std::memcpy(static_cast<void*>(&header), mapping.words(), sizeof header);
    const bool is_ring =
        header.magic == kRingMagic && header.version == kRingVersion && header.slots_at % kFlightSlotBytes == 0;
    const bool fits = header.slots_at <= mapping.bytes() && header.source_bytes <= mapping.bytes() - kSourceAt &&
                      header.events <= (mapping.bytes() - header.slots_at) / kFlightSlotBytes;
    return is_ring && fits ? std::optional(header) : std::nullopt;
}

std::uint8_t* bytes_of(const SharedMapping& mapping) { return reinterpret_cast<std::uint8_t*>(mapping.words()); }

std::string note_of(const SharedMapping& mapping) {
    const auto* const note = reinterpret_cast<const char*>(bytes_of(mapping) + kHeaderBytes);
    return {note, std::find(note, note + kFlightNoteBytes, '\0')};
}

}  // namespace

std::expected<FlightRing, std::string> FlightRing::create(const fs::path& directory, const FlightSource& source,
                                                          std::size_t events) {
    if (const auto made = make_own_directory(directory); !made) { return std::unexpected(made.error()); }
    static std::atomic<int> rings = 0;  // rings of this process; only tests make more than one
    const std::string name = fmt::format("{}.{}.{}.{}", source.machine, source.process, getpid(), rings++);
    const fs::path unfinished = directory / (name + ".new");
    const fs::path path = directory / (name + ".ring");
    const std::vector<std::uint8_t> source_bytes = encode_source(source);
    const std::size_t slots_at =
        (kSourceAt + source_bytes.size() + kFlightSlotBytes - 1) / kFlightSlotBytes * kFlightSlotBytes;
    const std::size_t bytes = slots_at + events * kFlightSlotBytes;
    Descriptor file(open(unfinished.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600));
    if (!file.is_open()) { return cannot(unfinished, "create it"); }
    // Reserves the memory now, because SIGBUS would end the process if a page were missing later.
    errno = posix_fallocate(file.get(), 0, static_cast<off_t>(bytes));
    SharedMapping mapping(file.get(), errno == 0 ? bytes : 0, PROT_READ | PROT_WRITE);
    if (mapping.words() == nullptr || flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
        const auto error = cannot(unfinished, "reserve its memory");
        unlink(unfinished.c_str());
        return error;
    }
    std::memset(mapping.words(), 0, bytes);  // touches each page, so that no later store waits for one
    const Header header{.events = events, .source_bytes = source_bytes.size(), .slots_at = slots_at};
    std::memcpy(mapping.words(), &header, sizeof header);
    std::memcpy(bytes_of(mapping) + kSourceAt, source_bytes.data(), source_bytes.size());
    std::error_code error;
    fs::rename(unfinished, path, error);  // only a complete and locked ring gets its name
    return FlightRing(path, std::move(file), std::move(mapping), slots_at, events);
}

FlightRing::FlightRing(FlightRing&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::move(other.file_)),
      mapping_(std::move(other.mapping_)),
      slots_(other.slots_),
      events_(other.events_),
      number_(other.number_.load()) {}

FlightRing::~FlightRing() {
    if (file_.is_open()) { unlink(path_.c_str()); }
}

void FlightRing::add(const FlightEvent& event) {
    const std::uint64_t before = number_.fetch_add(1, std::memory_order_relaxed);
    EventSlot::write(slots_ + before % events_ * EventSlot::kWords, before + 1, event);
}

void FlightRing::set_note(std::string_view text) {
    const std::size_t bytes = std::min(text.size(), kFlightNoteBytes);
    std::memcpy(bytes_of(mapping_) + kHeaderBytes, text.data(), bytes);
}

std::expected<FlightSnapshot, std::string> read_ring(const fs::path& path) {
    const Descriptor file(open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
    if (!file.is_open()) { return cannot(path, "open it"); }
    struct stat status {};
    const bool has_size = fstat(file.get(), &status) == 0 && status.st_size > 0;
    const std::size_t bytes = has_size ? std::min(static_cast<std::size_t>(status.st_size), kMaxBytes) : 1;
    const SharedMapping mapping(file.get(), bytes, PROT_READ | PROT_WRITE);
    const auto header = mapping.words() == nullptr ? std::nullopt : header_of(mapping);
    if (!header) { return std::unexpected(path.string() + ": is not a flight recorder ring of this version"); }
    auto source = decode_source({bytes_of(mapping) + kSourceAt, header->source_bytes});
    if (!source) { return std::unexpected(path.string() + ": " + source.error()); }
    FlightSnapshot snapshot{.source = *std::move(source), .events = {}, .note = note_of(mapping)};
    std::uint64_t* const slots = mapping.words() + header->slots_at / sizeof(std::uint64_t);
    for (std::size_t i = 0; i < header->events; ++i) {
        if (const auto read = EventSlot::read(slots + i * EventSlot::kWords)) {
            snapshot.events.push_back({read->number, read->record});
        }
    }
    std::ranges::sort(snapshot.events, {}, &NumberedEvent::number);
    return snapshot;
}

std::vector<fs::path> rings_in(const fs::path& directory) {
    std::vector<fs::path> rings;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(directory, error)) {
        if (entry.path().extension() == ".ring") { rings.push_back(entry.path()); }
    }
    std::ranges::sort(rings);
    return rings;
}

std::optional<LeftRing> LeftRing::claim(const fs::path& path) {
    Descriptor file(open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
    const bool is_left = flock(file.get(), LOCK_EX | LOCK_NB) == 0 && is_still_named(path, file.get());
    return is_left ? std::optional(LeftRing(path, std::move(file))) : std::nullopt;
}

void LeftRing::remove() { unlink(path_.c_str()); }

}  // namespace lockstep
