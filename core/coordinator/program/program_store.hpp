// The programs that a coordinator knows: whole, or open, with more to come.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>

#include "core/coordinator/program/known_program.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// Makes the store that keeps a program's blocks.
using MakeRows = std::function<std::unique_ptr<RowStore>(std::size_t width)>;
std::unique_ptr<RowStore> memory_rows(std::size_t width);

/// Keeps only the newest few programs, and those that run.
class ProgramStore {
public:
    explicit ProgramStore(const MachineConfig& machine, MakeRows make_rows = memory_rows)
        : machine_(machine), make_rows_(std::move(make_rows)) {}

    /// Takes a whole program.
    void accept(std::uint64_t id, const Program& program);
    /// Takes a part of a program. Parts are numbered from 0 and are taken in this order. A part that was taken before
    /// is acknowledged again. A part that comes too early is not taken. The reply says how many parts have been taken.
    struct Taken {
        Reply reply;
        bool is_new = false;  // the part was taken now
    };
    Taken take(const ProgramPart& part, Slot now);
    /// Jobs of the program continue.
    void forget(std::uint64_t id);
    /// Returns null if nothing of it has arrived, or if newer programs replaced it.
    std::shared_ptr<const KnownProgram> find(std::uint64_t id) const;
    /// Returns why nothing of it was taken, or null if something was taken or nothing has arrived.
    const Reply* refusal_of(std::uint64_t id) const;
    /// The owner of the machine calls it in each slot. Cuts open programs if their sender is silent. `missed`: slots
    /// before this one in which this process was stalled.
    void tend(Slot now, Slot missed);

    static constexpr std::size_t kProgramsKept = 4;
    static constexpr double kSenderSilence_s = 10;

private:
    struct Entry {
        std::uint64_t id = 0;
        Identity client = 0;                    // the program's sender
        std::shared_ptr<KnownProgram> program;  // null: its first part was refused
        std::uint32_t parts = 0;                // parts taken
        Slot received = 0;                      // when the last part or repetition was received
        std::optional<Reply> refusal;           // of the part that was refused
    };
    Entry* entry_of(std::uint64_t id);
    Entry& begin(std::uint64_t id, const ProgramHead& head);
    void take_next(Entry& entry, const ProgramPart& part);

    MachineConfig machine_;
    MakeRows make_rows_;
    std::list<Entry> programs_;  // the oldest first
};

}  // namespace lockstep
