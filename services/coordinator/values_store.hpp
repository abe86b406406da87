// Holds the machine's values that outlive programs. It publishes them and writes them to the coordinator's file after a
// change.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
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
    ValuesStore(const std::filesystem::path& file, RevisedValues loaded, NumberedText::OnFailure on_failure)
        : keeper_(loaded.revision, std::move(loaded.values)), file_(file, values_text, on_failure) {}

    ValueKeeper& keeper() { return keeper_; }
    /// Passes a program's first part to ValueKeeper::accept. From a later part it takes the values that the program
    /// leaves.
    std::expected<void, ValuesRefusal> accept(const ProgramChunk& chunk, const ProgramDocument& part,
                                              ValueKeeper::Circumstances now);
    /// For a coordinator that does not own the machine: takes over the values that the owner published.
    void follow(const MachineValues& values);
    /// Call it in each loop of the owner. Writes a change to the file. Returns the values to publish after each change
    /// and several times a second, otherwise null. The result is valid until the next call.
    const MachineValues* step(std::chrono::nanoseconds now, const Term& term);

private:
    static constexpr std::chrono::milliseconds kPublishEvery{200};
    static constexpr std::chrono::seconds kWriteAgainAfter{5};  // after a failed write

    bool is_on_disk() const { return file_.kept() == keeper_.changes(); }
    void write(std::chrono::nanoseconds now);

    ValueKeeper keeper_;
    NewestFile<RevisedValues> file_;      // numbered by the keeper's count of changes
    std::vector<std::uint8_t> followed_;  // the owner's bytes read last
    std::uint64_t written_ = 0;           // the change given to the file last
    std::chrono::nanoseconds written_at_{};
    std::optional<std::chrono::nanoseconds> published_at_;
    std::pair<std::uint64_t, bool> published_;  // the change, and whether it is on the disk
    MachineValues message_;                     // as last published
};

}  // namespace lockstep
