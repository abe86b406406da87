#include "services/flight/flight_ring.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

#include "services/flight/flight_messages.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMagic = 0x4c53464c49474854U;  // LSFLIGHT
constexpr std::uint64_t kVersion = 1;
constexpr std::size_t kHeaderBytes = kFlightSlotBytes;
constexpr std::size_t kSlotWords = kFlightSlotBytes / sizeof(std::uint64_t);
constexpr std::size_t kMaxBytes = std::size_t{128} << 20;  // more is no ring
using EventWords = std::array<std::uint64_t, kSlotWords - 1>;
static_assert(sizeof(EventWords) == sizeof(FlightEvent));
static_assert(std::atomic_ref<std::uint64_t>::is_always_lock_free, "other processes read it");

struct Header {
    std::uint64_t magic = kMagic;
    std::uint64_t version = kVersion;
    std::uint64_t events = 0;
    std::uint64_t source_bytes = 0;  // behind the header
    std::uint64_t slots_at = 0;      // byte
};

std::unexpected<std::string> error_of(const fs::path& path, const char* action) {
    return std::unexpected(path.string() + ": cannot " + action + ": " + std::strerror(errno));
}

std::atomic_ref<std::uint64_t> word(std::uint64_t* at) { return std::atomic_ref<std::uint64_t>(*at); }

/// In a directory that everybody may write to: it must be this user's own.
std::expected<void, std::string> make_directory(const fs::path& directory) {
    if (mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST) { return error_of(directory, "make it"); }
    struct stat status {};
    if (lstat(directory.c_str(), &status) != 0) { return error_of(directory, "look at it"); }
    if (!S_ISDIR(status.st_mode) || status.st_uid != geteuid()) {
        return std::unexpected(directory.string() + ": is not a directory of this user; remove it");
    }
    return {};
}

/// A mapping that ends with the object; the file stays open.
struct Mapping {
    std::uint64_t* words = nullptr;
    std::size_t bytes = 0;

    Mapping(int file, std::size_t size, int protection) : bytes(size) {
        void* const at = mmap(nullptr, size, protection, MAP_SHARED, file, 0);
        words = at == MAP_FAILED ? nullptr : static_cast<std::uint64_t*>(at);
    }
    ~Mapping() {
        if (words != nullptr) { munmap(words, bytes); }
    }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
};

/// Whatever the file says, nothing beyond it is looked at.
std::optional<Header> header_of(const Mapping& mapping) {
    Header header;
    if (mapping.bytes < kHeaderBytes) { return std::nullopt; }
    std::memcpy(static_cast<void*>(&header), mapping.words, sizeof header);
    const bool is_ring =
        header.magic == kMagic && header.version == kVersion && header.slots_at % kFlightSlotBytes == 0;
    const bool fits = header.slots_at <= mapping.bytes && header.source_bytes <= mapping.bytes - kHeaderBytes &&
                      header.events <= (mapping.bytes - header.slots_at) / kFlightSlotBytes;
    return is_ring && fits ? std::optional(header) : std::nullopt;
}

/// Nothing: empty, or being written.
std::optional<NumberedEvent> event_at(std::uint64_t* slot) {
    const std::uint64_t number = word(slot).load(std::memory_order_acquire);
    EventWords words;
    for (std::size_t i = 0; i < words.size(); ++i) { words[i] = word(slot + 1 + i).load(std::memory_order_relaxed); }
    std::atomic_thread_fence(std::memory_order_acquire);
    if (number == 0 || word(slot).load(std::memory_order_relaxed) != number) { return std::nullopt; }
    return NumberedEvent{number, std::bit_cast<FlightEvent>(words)};
}

}  // namespace

std::expected<FlightRing, std::string> FlightRing::create(const fs::path& directory, const FlightSource& source,
                                                          std::size_t events) {
    if (const auto made = make_directory(directory); !made) { return std::unexpected(made.error()); }
    static std::atomic<int> rings = 0;  // of this process: more than one in tests alone
    const std::string name =
        source.machine + "." + source.process + "." + std::to_string(getpid()) + "." + std::to_string(rings++);
    const fs::path unfinished = directory / (name + ".new");
    const fs::path path = directory / (name + ".ring");
    const std::vector<std::uint8_t> source_bytes = encode_source(source);
    const std::size_t slots_at =
        (kHeaderBytes + source_bytes.size() + kFlightSlotBytes - 1) / kFlightSlotBytes * kFlightSlotBytes;
    const std::size_t bytes = slots_at + events * kFlightSlotBytes;
    const int file = open(unfinished.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (file < 0) { return error_of(unfinished, "make it"); }
    // Memory is had now or not at all: a page that is not there later would end the process.
    errno = posix_fallocate(file, 0, static_cast<off_t>(bytes));
    Mapping mapping(file, errno == 0 ? bytes : 0, PROT_READ | PROT_WRITE);
    if (mapping.words == nullptr || flock(file, LOCK_EX | LOCK_NB) != 0) {
        const auto error = error_of(unfinished, "have its memory");
        unlink(unfinished.c_str());
        close(file);
        return error;
    }
    std::memset(mapping.words, 0, bytes);  // and touched, so that no store waits for it
    const Header header{.events = events, .source_bytes = source_bytes.size(), .slots_at = slots_at};
    std::memcpy(mapping.words, &header, sizeof header);
    std::memcpy(reinterpret_cast<std::uint8_t*>(mapping.words) + kHeaderBytes, source_bytes.data(),
                source_bytes.size());
    std::error_code error;
    fs::rename(unfinished, path, error);  // whoever sees it finds it whole, and locked
    std::uint64_t* const words = std::exchange(mapping.words, nullptr);
    return FlightRing(path, file, words, bytes, words + slots_at / sizeof(std::uint64_t), events);
}

FlightRing::FlightRing(FlightRing&& other) noexcept
    : path_(std::move(other.path_)),
      file_(other.file_),
      words_(std::exchange(other.words_, nullptr)),
      bytes_(other.bytes_),
      slots_(other.slots_),
      events_(other.events_),
      number_(other.number_) {}

FlightRing::~FlightRing() {
    if (words_ == nullptr) { return; }
    unlink(path_.c_str());
    munmap(words_, bytes_);
    close(file_);
}

void FlightRing::add(const FlightEvent& event) {
    std::uint64_t* const slot = slots_ + number_ % events_ * kSlotWords;
    const auto words = std::bit_cast<EventWords>(event);
    word(slot).store(0, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    for (std::size_t i = 0; i < words.size(); ++i) { word(slot + 1 + i).store(words[i], std::memory_order_relaxed); }
    word(slot).store(++number_, std::memory_order_release);
}

std::expected<FlightSnapshot, std::string> read_ring(const fs::path& path) {
    const int file = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) { return error_of(path, "open it"); }
    struct stat status {};
    const bool has_size = fstat(file, &status) == 0 && status.st_size > 0;
    const std::size_t bytes = has_size ? std::min(static_cast<std::size_t>(status.st_size), kMaxBytes) : 1;
    const Mapping mapping(file, bytes, PROT_READ | PROT_WRITE);
    close(file);
    const auto header = mapping.words == nullptr ? std::nullopt : header_of(mapping);
    if (!header) { return std::unexpected(path.string() + ": is no ring of a flight recorder of this version"); }
    const auto* const source_at = reinterpret_cast<const std::uint8_t*>(mapping.words) + kHeaderBytes;
    auto source = decode_source({source_at, header->source_bytes});
    if (!source) { return std::unexpected(path.string() + ": " + source.error()); }
    FlightSnapshot snapshot{*std::move(source), {}};
    std::uint64_t* const slots = mapping.words + header->slots_at / sizeof(std::uint64_t);
    for (std::size_t i = 0; i < header->events; ++i) {
        if (const auto event = event_at(slots + i * kSlotWords)) { snapshot.events.push_back(*event); }
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
    const int file = open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (file < 0) { return std::nullopt; }
    struct stat open_one {};
    struct stat named {};
    const bool is_left = flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &open_one) == 0 &&
                         stat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino;
    if (is_left) { return LeftRing(path, file); }
    close(file);
    return std::nullopt;
}

LeftRing::LeftRing(LeftRing&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

LeftRing::~LeftRing() {
    if (file_ >= 0) { close(file_); }
}

void LeftRing::remove() { unlink(path_.c_str()); }

}  // namespace lockstep
