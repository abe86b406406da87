#include "services/wire/shared/state_board.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "services/files/directories.hpp"
#include "services/wire/dds/protocol_version.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

using StateSlot = NumberedSlot<lockstep_wire_AxisState>;

constexpr std::size_t kPartBytes = std::size_t{1} << 16;  // a multiple of every processor's page size
constexpr std::size_t kPartWords = kPartBytes / sizeof(std::uint64_t);
constexpr std::size_t kLineWords = 8;
constexpr std::size_t kBytes = kMaxAxes * kPartBytes;

// Word offsets in a part, after a margin that differs for each axis. The margin puts the first lines of the parts into
// different cache sets, because every loop reads all of them.
constexpr std::size_t kRules = 0;
constexpr std::size_t kWritten = 1;
constexpr std::size_t kSlots = kLineWords;
static_assert((kMaxAxes - 1) * kLineWords + kSlots + kStatesKept * StateSlot::kWords <= kPartWords);

/// The writer and the reader must have the same value.
constexpr std::uint64_t kRulesHere = 0x4c53'5354'0000'0000U | std::uint64_t{kProtocol} << 16 | StateSlot::kWords;

std::unexpected<std::string> cannot_share(const fs::path& path, const char* action) {
    return cannot("network.one_host: " + path.string(), action);
}

std::uint64_t* slot_of(std::uint64_t* part, std::uint64_t number) {
    return part + kSlots + number % kStatesKept * StateSlot::kWords;
}

/// Whether these bytes may be read as booleans. Another process may have written anything.
bool has_booleans(const lockstep_wire_AxisState& state) {
    const auto is_one = [](const bool& field) {
        unsigned char byte = 0;
        std::memcpy(&byte, &field, sizeof byte);
        return byte <= 1;
    };
    return is_one(state.has_veto) && is_one(state.at_rest) && is_one(state.homed) && is_one(state.hears_owner) &&
           is_one(state.has_touch);
}

/// Locks the axis's part until the file is closed or the process ends. Returns false if another process holds the lock.
bool lock_part(int file, std::uint32_t axis) {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    lock.l_start = static_cast<off_t>(axis * kPartBytes);
    lock.l_len = static_cast<off_t>(kPartBytes);
    return fcntl(file, F_OFD_SETLK, &lock) == 0;
}

}  // namespace

std::expected<StateBoardFile, std::string> StateBoardFile::open(const fs::path& path) {
    if (const auto made = make_own_directory(path.parent_path()); !made) { return std::unexpected(made.error()); }
    while (true) {
        Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600));
        if (!file.is_open()) { return cannot_share(path, "open it"); }
        StateBoardFile opened(path, std::move(file));
        if (flock(opened.descriptor(), LOCK_SH) != 0) { return cannot_share(path, "lock it"); }
        if (!opened.is_current()) { continue; }
        // Reserves the memory now, because SIGBUS would end the process if a page were missing later.
        errno = posix_fallocate(opened.descriptor(), 0, kBytes);
        if (errno != 0) { return cannot_share(path, "reserve its 4 MB of memory"); }
        return opened;
    }
}

StateBoardFile::~StateBoardFile() {
    const bool is_last = flock(file_.get(), LOCK_EX | LOCK_NB) == 0;
    if (is_last && is_current()) { unlink(path_.c_str()); }
}

std::expected<StateBoardWriter, std::string> StateBoardWriter::open(const fs::path& path, std::uint32_t axis) {
    auto file = StateBoardFile::open(path);
    if (!file) { return std::unexpected(file.error()); }
    if (!lock_part(file->descriptor(), axis)) {
        return std::unexpected(
            fmt::format("axis {} is already run by another process ({}); end that process first", axis, path.string()));
    }
    SharedMapping part(file->descriptor(), kPartBytes, PROT_READ | PROT_WRITE, MAP_POPULATE, axis * kPartBytes);
    if (part.words() == nullptr) { return cannot_share(path, "map it"); }
    std::uint64_t* const words = part.words() + axis * kLineWords;
    if (shared_word(words + kRules).load() != kRulesHere) {  // new, or written by another version
        shared_word(words + kRules).store(0);
        std::fill(words + kWritten, part.words() + kPartWords, 0);
        shared_word(words + kRules).store(kRulesHere);
    }
    return StateBoardWriter(std::move(*file), std::move(part), words);
}

void StateBoardWriter::write(const AxisState& state) {
    const std::uint64_t number = shared_word(words_ + kWritten).load(std::memory_order_relaxed) + 1;
    StateSlot::write(slot_of(words_, number), number, to_wire(state));
    shared_word(words_ + kWritten).store(number, std::memory_order_release);
}

bool StateBoardWriter::is_current() const {
    return file_.is_current() && shared_word(words_ + kRules).load(std::memory_order_relaxed) == kRulesHere;
}

std::expected<StateBoardReader, std::string> StateBoardReader::open(const fs::path& path,
                                                                    std::optional<std::uint32_t> own) {
    auto file = StateBoardFile::open(path);
    if (!file) { return std::unexpected(file.error()); }
    SharedMapping parts(file->descriptor(), kBytes, PROT_READ, MAP_POPULATE);
    if (parts.words() == nullptr) { return cannot_share(path, "map it"); }
    return StateBoardReader(std::move(*file), std::move(parts), own);
}

StateBoardReader::StateBoardReader(StateBoardFile file, SharedMapping parts, std::optional<std::uint32_t> own)
    : file_(std::move(file)), parts_(std::move(parts)), own_(own) {
    for (std::uint32_t axis = 0; axis < kMaxAxes; ++axis) {
        read_[axis] = shared_word(part_of(axis) + kWritten).load();
    }
}

std::uint64_t* StateBoardReader::part_of(std::uint32_t axis) const {
    return parts_.words() + axis * (kPartWords + kLineWords);
}

std::uint64_t StateBoardReader::written_by(std::uint32_t axis) {
    const std::uint64_t written = shared_word(part_of(axis) + kWritten).load(std::memory_order_acquire);
    std::uint64_t& read = read_[axis];
    if (written == read) { return written; }
    if (shared_word(part_of(axis) + kRules).load(std::memory_order_relaxed) != kRulesHere) {
        refusals_.add(fmt::format(
            "axis {} writes to {} in the format of another version; install the same version for all processes", axis,
            path().string()));
        read = written;
    }
    const std::uint64_t kept_from = written - std::min<std::uint64_t>(written, kStatesKept);
    read = std::clamp(read, kept_from, written);  // `written` may be less than `read`: the part was initialized again
    return written;
}

std::optional<AxisState> StateBoardReader::state_of(std::uint32_t axis, std::uint64_t number) {
    const auto read = StateSlot::read(slot_of(part_of(axis), number));
    if (!read || read->number != number) { return std::nullopt; }  // overwritten meanwhile
    if (read->record.axis != axis || !has_booleans(read->record)) {
        refusals_.add(
            fmt::format("{}: the part of axis {} does not contain a state of that axis", path().string(), axis));
        return std::nullopt;
    }
    auto state = from_wire(read->record);
    if (state) { return *state; }
    refusals_.add(std::move(state.error()));
    return std::nullopt;
}

}  // namespace lockstep
