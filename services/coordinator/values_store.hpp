// The machine's values that outlive programs: read from the coordinator's file, published, and written after a change.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/coordinator/values/value_keeper.hpp"
#include "core/protocol/machine_values.hpp"
#include "services/documents/program_document.hpp"
#include "services/documents/values/values_document.hpp"
#include "services/files/newest_file.hpp"

namespace lockstep {

class ValuesStore {
public:
    /// `loaded`: the content of the file.
    ValuesStore(const std::filesystem::path& file, RevisedValues loaded, NewestFile::OnFailure on_failure)
        : keeper_(loaded.revision, std::move(loaded.values)), file_(file, on_failure) {}

    ValueKeeper& keeper() { return keeper_; }
    /// A program's first part, as ValueKeeper::accept, or another one with the values that it leaves.
    std::expected<void, ValuesRefusal> accept(const ProgramChunk& chunk, const ProgramDocument& part,
                                              ValueKeeper::Circumstances now);
    /// The owner's values, in a coordinator that does not own the machine.
    void follow(const MachineValues& values);
    /// In each loop of the owner: writes a change. Returns the values to publish, valid until the next call: after each
    /// change, and several times a second. Else null.
    const MachineValues* step(std::chrono::nanoseconds now, const Term& term);

private:
    static constexpr std::chrono::milliseconds kPublishEvery{200};
    static constexpr std::chrono::seconds kWriteAgainAfter{5};  // if it failed

    bool is_on_disk() const { return file_.kept() == keeper_.changes(); }
    void write(std::chrono::nanoseconds now);

    ValueKeeper keeper_;
    NewestFile file_;                     // its numbers are the keeper's count of changes
    std::vector<std::uint8_t> followed_;  // the owner's bytes that were read last
    std::uint64_t written_ = 0;           // the change that was given to the file last
    std::chrono::nanoseconds written_at_{};
    std::optional<std::chrono::nanoseconds> published_at_;
    std::pair<std::uint64_t, bool> published_;  // the change, and whether it was on the disk
    MachineValues message_;                     // as they were published last
};

}  // namespace lockstep
