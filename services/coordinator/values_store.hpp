// The machine's values that outlive programs: read from the coordinator's file, published, and written after a change.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>

#include "core/coordinator/values/value_keeper.hpp"
#include "core/protocol/machine_values.hpp"
#include "services/documents/program_document.hpp"
#include "services/documents/values/values_document.hpp"
#include "services/files/newest_file.hpp"

namespace lockstep {

class ValuesStore {
public:
    /// `loaded`: what the file contains.
    ValuesStore(const std::filesystem::path& file, RevisedValues loaded, NewestFile::OnFailure on_failure)
        : keeper_(loaded.revision, std::move(loaded.values)), in_file_(loaded.revision), file_(file, on_failure) {}

    ValueKeeper& keeper() { return keeper_; }
    /// A program that has arrived, as ValueKeeper::accept.
    std::expected<void, std::string> accept(std::uint64_t id, const ProgramDocument& document,
                                            ValueKeeper::Circumstances now);
    /// The owner's values, in a coordinator that does not own the machine.
    void follow(const MachineValues& values);
    /// In each loop of the owner: writes what has changed. Returns what to publish, several times a second.
    std::optional<MachineValues> step(std::chrono::nanoseconds now, const Term& term);

private:
    static constexpr std::chrono::milliseconds kPublishEvery{200};
    static constexpr std::chrono::seconds kWriteAgainAfter{5};  // if it failed

    /// The revision that is on the disk.
    std::uint64_t kept() const { return file_.kept() == 0 ? in_file_ : file_.kept(); }
    void write(std::chrono::nanoseconds now);

    ValueKeeper keeper_;
    std::uint64_t in_file_;  // the revision that was loaded
    NewestFile file_;
    std::uint64_t written_ = 0;  // the revision handed to the file last
    std::chrono::nanoseconds written_at_{};
    std::optional<std::chrono::nanoseconds> published_at_;
    std::uint64_t published_kept_ = 0;
};

}  // namespace lockstep
