// What the axes of a machine say of themselves, in memory that its processes share, for a machine that runs on one
// host: each axis writes in a part of its own, which it alone has mapped for writing, and all read all. Nobody waits
// for anybody, and a process that is killed while it writes has not said it.
//
// The file has a part for each axis: a word that says by what rules it is written, a word that counts the states its
// axis has ever said, and the newest kStatesKept of them, in the type of axis.idl. It goes with the last process that
// uses it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>

#include "core/machine.hpp"
#include "core/protocol/messages.hpp"
#include "core/protocol/peer_evidence.hpp"
#include "idl/dds/axis.h"
#include "services/files/named_file.hpp"
#include "services/runtime/numbered_slot.hpp"
#include "services/runtime/shared_mapping.hpp"
#include "services/wire/dds/refusals.hpp"

namespace lockstep {

/// The file, there for as long as anybody uses it.
class StateBoardFile {
public:
    static std::expected<StateBoardFile, std::string> open(const std::filesystem::path& path);
    StateBoardFile(StateBoardFile&& other) noexcept;
    StateBoardFile& operator=(StateBoardFile&&) = delete;
    ~StateBoardFile();

    /// False: it was removed, or another took its place.
    bool is_current() const { return is_still_named(path_, file_); }

    int descriptor() const { return file_; }
    const std::filesystem::path& path() const { return path_; }

private:
    StateBoardFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
    std::filesystem::path path_;
    int file_;  // below 0: moved from
};

class StateBoardWriter {
public:
    /// Error: the file, why not, and the remedy; another process of this host writes for the axis.
    static std::expected<StateBoardWriter, std::string> open(const std::filesystem::path& path, std::uint32_t axis);

    /// Never waits, allocates nothing.
    void write(const AxisState& state);
    /// False: the file was removed, or another took its place; or its part was overwritten, and nobody believes it.
    bool is_current() const;

private:
    StateBoardWriter(StateBoardFile file, SharedMapping mapping, std::uint64_t* words)
        : file_(std::move(file)), mapping_(std::move(mapping)), words_(words) {}
    StateBoardFile file_;
    SharedMapping mapping_;
    std::uint64_t* words_;
};

class StateBoardReader {
public:
    /// own: whose states are not taken. What was said before is not heard.
    static std::expected<StateBoardReader, std::string> open(const std::filesystem::path& path,
                                                             std::optional<std::uint32_t> own);

    /// Calls use(AxisState&&) for each state said since the last call, oldest first per axis. Returns how many. Of an
    /// axis that has said more than kStatesKept the oldest are gone.
    template <typename Use>
    std::size_t take(Use use) {
        std::size_t used = 0;
        for (std::uint32_t axis = 0; axis < kMaxAxes; ++axis) {
            const std::uint64_t said = said_by(axis);
            for (; axis != own_ && heard_[axis] < said; ++heard_[axis]) {
                if (auto state = state_of(axis, heard_[axis] + 1)) {
                    use(std::move(*state));
                    ++used;
                }
            }
        }
        return used;
    }

    const Refusals& refusals() const { return refusals_; }
    const std::filesystem::path& path() const { return file_.path(); }
    bool is_current() const { return file_.is_current(); }

private:
    StateBoardReader(StateBoardFile file, SharedMapping parts, std::optional<std::uint32_t> own);
    std::uint64_t* part_of(std::uint32_t axis) const;
    /// How many states the axis has said in all; what cannot be had any more counts as heard from then on.
    std::uint64_t said_by(std::uint32_t axis);
    /// Nothing: it is gone, or not believed.
    std::optional<AxisState> state_of(std::uint32_t axis, std::uint64_t number);

    StateBoardFile file_;
    SharedMapping parts_;
    std::optional<std::uint32_t> own_;
    std::array<std::uint64_t, kMaxAxes> heard_{};
    Refusals refusals_;
};

}  // namespace lockstep
