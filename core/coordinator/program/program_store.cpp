#include "core/coordinator/program/program_store.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

void refuse(Reply& reply, const ProgramCut& cut) {
    reply.status = ReplyStatus::Refused;
    reply.fault = cut.why;
    reply.text = line_label(cut.line) + cut.text;
}

}  // namespace

std::unique_ptr<RowStore> memory_rows(std::size_t width) { return std::make_unique<MemoryRows>(width); }

ProgramStore::Entry* ProgramStore::entry_of(std::uint64_t id) {
    const auto found = std::ranges::find(programs_, id, &Entry::id);
    return found == programs_.end() ? nullptr : &*found;
}

std::shared_ptr<const KnownProgram> ProgramStore::find(std::uint64_t id) const {
    const auto found = std::ranges::find(programs_, id, &Entry::id);
    return found == programs_.end() ? nullptr : found->program;
}

const Reply* ProgramStore::refusal_of(std::uint64_t id) const {
    const auto found = std::ranges::find(programs_, id, &Entry::id);
    return found == programs_.end() || found->program || !found->refusal ? nullptr : &*found->refusal;
}

void ProgramStore::forget(std::uint64_t id) {
    std::erase_if(programs_, [id](const Entry& entry) { return entry.id == id; });
}

/// A program that runs is in use elsewhere, too, and is not removed.
ProgramStore::Entry& ProgramStore::begin(std::uint64_t id, const ProgramHead& head) {
    forget(id);
    Entry entry{.id = id};
    auto program = KnownProgram::begin(machine_, head, make_rows_(KnownProgram::row_width(head)));
    if (program) {
        entry.program = std::make_shared<KnownProgram>(*std::move(program));
    } else {
        refuse(entry.refusal.emplace(), program.error());
    }
    programs_.push_back(std::move(entry));
    for (auto old = programs_.begin(); programs_.size() > kProgramsKept && &*old != &programs_.back();) {
        old = old->program.use_count() > 1 ? std::next(old) : programs_.erase(old);
    }
    return programs_.back();
}

void ProgramStore::accept(std::uint64_t id, const Program& program) {
    const Entry& entry = begin(id, program.head());
    if (!entry.program) { return; }
    if (entry.program->append(program.blocks)) { entry.program->end(); }
}

ProgramStore::Taken ProgramStore::take(const ProgramPart& part, Slot now) {
    Reply reply{.client = part.client, .sequence = part.sequence};
    Entry* entry = entry_of(part.program);
    if (entry == nullptr && part.index == 0 && !part.is_question) {
        entry = &begin(part.program, part.head);
        entry->client = part.client;
    }
    if (entry == nullptr || entry->client != part.client) {
        refuse(reply, {FaultCode::UnknownProgram, std::nullopt,
                       "the beginning of the program has not arrived; send it again"});
        return {reply};
    }
    entry->received = now;
    const bool is_next = part.index == entry->parts && !part.is_question && !entry->refusal;
    if (is_next && entry->program->is_open()) { take_next(*entry, part); }
    if (is_next && entry->parts == part.index && entry->program->cut()) {
        refuse(entry->refusal.emplace(), *entry->program->cut());
    }
    if (entry->refusal && (part.is_question || part.index >= entry->parts)) {
        reply.status = entry->refusal->status;
        reply.fault = entry->refusal->fault;
        reply.text = entry->refusal->text;
    }
    reply.parts = entry->parts;
    reply.free_blocks = entry->program && entry->program->is_open() ? entry->program->free() : 0;
    return {reply, is_next && entry->parts > part.index};
}

/// A part for which there is no room is not taken. Its sender repeats it.
void ProgramStore::take_next(Entry& entry, const ProgramPart& part) {
    KnownProgram& program = *entry.program;
    if (part.blocks.size() > program.free()) { return; }
    if (!part.blocks.empty() && !program.append(part.blocks)) { return; }
    ++entry.parts;
    program.note_share(part.share);
    if (!part.is_last) { return; }
    if (part.cut.empty()) { return program.end(); }
    program.cut({FaultCode::ProgramCutShort, std::nullopt, part.cut});
}

void ProgramStore::tend(Slot now, Slot missed) {
    const auto patience = static_cast<Slot>(
        std::ceil(kSenderSilence_s * machine_.ticks_per_second() / static_cast<double>(machine_.slot_ticks().value)));
    for (Entry& entry : programs_) {
        entry.received += missed;
        const bool is_open = entry.program && entry.program->is_open();
        if (!is_open || now - entry.received <= patience) { continue; }
        entry.program->cut({FaultCode::SenderSilent, std::nullopt,
                            "nothing was received from the program's sender for " +
                                std::to_string(std::lround(kSenderSilence_s)) +
                                " s; the machine runs the part that it has, and rests"});
    }
}

}  // namespace lockstep
