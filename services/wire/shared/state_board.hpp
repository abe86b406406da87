// The states of a machine's axes in shared memory, for a machine on one host. Each axis writes in its own part, which
// only its process has mapped for writing, and all processes read all parts. No process waits for another, and readers
// ignore the state of a process that is killed during a write.
//
// The file has a part for each axis. A part has a word for the format version, a word that counts all states that the
// axis has written, and the newest kStatesKept states, in the type of axis.idl. The last process that uses the file
// deletes it.
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
#include "services/files/descriptor.hpp"
#include "services/files/named_file.hpp"
#include "services/runtime/numbered_slot.hpp"
#include "services/runtime/shared_mapping.hpp"
#include "services/wire/dds/refusals.hpp"

namespace lockstep {

/// The file, which exists while any process uses it.
class StateBoardFile {
public:
    static std::expected<StateBoardFile, std::string> open(const std::filesystem::path& path);
    StateBoardFile(StateBoardFile&&) = default;
    ~StateBoardFile();

    /// Returns false if the file was removed or replaced.
    bool is_current() const { return is_still_named(path_, file_.get()); }

    int descriptor() const { return file_.get(); }
    const std::filesystem::path& path() const { return path_; }

private:
    StateBoardFile(std::filesystem::path path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}
    std::filesystem::path path_;
    Descriptor file_;
};

class StateBoardWriter {
public:
    /// Error: the file cannot be used, or another process of this host writes for the axis; with the remedy.
    static std::expected<StateBoardWriter, std::string> open(const std::filesystem::path& path, std::uint32_t axis);

    /// Never waits and allocates nothing.
    void write(const AxisState& state);
    /// Returns false if the file was removed or replaced, or if the axis's part was overwritten, so that readers refuse
    /// it.
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
    /// The reader skips the states of axis `own`, and all states written before this call.
    static std::expected<StateBoardReader, std::string> open(const std::filesystem::path& path,
                                                             std::optional<std::uint32_t> own);

    /// Calls use(AxisState&&) for each state written since the last call, oldest first per axis. Returns their number.
    /// If an axis has written more than kStatesKept, the oldest are lost.
    template <typename Use>
    std::size_t take(Use use) {
        std::size_t used = 0;
        for (std::uint32_t axis = 0; axis < kMaxAxes; ++axis) {
            const std::uint64_t written = written_by(axis);
            for (; axis != own_ && read_[axis] < written; ++read_[axis]) {
                if (auto state = state_of(axis, read_[axis] + 1)) {
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
    /// Returns the number of states that the axis has written in total. Marks lost states as read.
    std::uint64_t written_by(std::uint32_t axis);
    /// Returns nullopt if the state is lost or refused.
    std::optional<AxisState> state_of(std::uint32_t axis, std::uint64_t number);

    StateBoardFile file_;
    SharedMapping parts_;
    std::optional<std::uint32_t> own_;
    std::array<std::uint64_t, kMaxAxes> read_{};
    Refusals refusals_;
};

}  // namespace lockstep
