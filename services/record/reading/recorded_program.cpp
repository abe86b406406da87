#include "services/record/reading/recorded_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "services/documents/program_document.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::analysis {
namespace {

std::expected<std::vector<std::uint8_t>, std::string> part_at(LogReader& log, std::uint64_t offset) {
    const auto event = log.event_at(offset);
    if (!event) { return std::unexpected(event.error()); }
    if (!*event || (*event)->offset != offset || kind_of((*event)->channel) != RecordKind::ProgramPart) {
        return std::unexpected(fmt::format("the log no longer has a part of a program at byte {}", offset));
    }
    auto part = decode_lcm<program_part_t>((*event)->data);
    if (!part) { return std::unexpected(part.error()); }
    return std::move(part->data);
}

/// Earlier versions cut a program anywhere, not between blocks. Such a program can only be read in one piece.
std::expected<Program, std::string> program_in_one_piece(LogReader& log, const std::vector<std::uint64_t>& offsets) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint64_t offset : offsets) {
        const auto part = part_at(log, offset);
        if (!part) { return std::unexpected(part.error()); }
        bytes.insert(bytes.end(), part->begin(), part->end());
        if (bytes.size() > kMaxProgramBytes) { break; }  // program_from_bytes refuses it
    }
    return program_from_bytes(bytes);
}

}  // namespace

RecordedProgram::RecordedProgram(Program program) : head_(program.head()), end_mm_(program.start_mm) {
    parts_.push_back({.offset = 0, .first = 0, .at_mm = head_.start_mm});
    note_blocks(program.blocks);
    loaded_.front() = {.part = 0, .blocks = std::move(program.blocks), .used = 1};
}

std::expected<std::shared_ptr<const RecordedProgram>, std::string> RecordedProgram::open(const ProgramPlaces& places) {
    auto log = LogReader::open(places.log);
    if (!log) { return std::unexpected(log.error()); }
    std::shared_ptr<RecordedProgram> program(new RecordedProgram(std::move(*log)));
    if (const auto scanned = program->scan(places.offsets); scanned) { return program; }
    auto whole = program_in_one_piece(*program->log_, places.offsets);
    if (!whole) { return std::unexpected(whole.error()); }
    return std::make_shared<const RecordedProgram>(std::move(*whole));
}

std::expected<void, std::string> RecordedProgram::scan(const std::vector<std::uint64_t>& offsets) {
    for (const std::uint64_t offset : offsets) {
        auto read = read_part(offset, parts_.empty());
        if (!read) { return std::unexpected(read.error()); }
        if (parts_.empty()) {
            head_ = read->head();
            end_mm_ = head_.start_mm;
        }
        if (read->blocks.size() > std::numeric_limits<std::uint32_t>::max() - size_) {
            return std::unexpected(std::string("the program has too many blocks to count"));
        }
        parts_.push_back({.offset = offset, .first = size_, .at_mm = end_mm_});
        note_blocks(read->blocks);
    }
    return {};
}

void RecordedProgram::note_blocks(const std::vector<Block>& blocks) {
    for (const Block& block : blocks) {
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { end_mm_ = move->target_mm; }
        if (std::holds_alternative<ProgramEvent>(block.action)) { events_.push_back(size_); }
        ++size_;
    }
}

/// Reads the part's blocks, and the head from the first part.
std::expected<Program, std::string> RecordedProgram::read_part(std::uint64_t offset, bool is_first) const {
    const auto bytes = part_at(*log_, offset);
    if (!bytes) { return std::unexpected(bytes.error()); }
    auto read = program_document_from_bytes(*bytes, is_first ? std::nullopt : std::optional(head_.axes.size()));
    if (!read) { return std::unexpected(read.error()); }
    return std::move(read->program);
}

std::size_t RecordedProgram::part_of(std::uint32_t number) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(parts_, number, {}, &Part::first) - parts_.begin()) - 1;
}

/// Returns null if the part cannot be read any more.
const std::vector<Block>* RecordedProgram::load(std::size_t part) const {
    const auto is_it = [&](const Loaded& loaded) { return loaded.used > 0 && loaded.part == part; };
    auto there = std::ranges::find_if(loaded_, is_it);
    if (there == loaded_.end()) {
        auto read = read_part(parts_[part].offset, part == 0);
        if (!read) {
            failure_ = read.error();
            return nullptr;
        }
        there = std::ranges::min_element(loaded_, {}, &Loaded::used);
        *there = {.part = part, .blocks = std::move(read->blocks), .used = 0};
    }
    there->used = ++uses_;
    return &there->blocks;
}

const Block* RecordedProgram::block(std::uint32_t number) const {
    if (ends_before(number)) { return nullptr; }
    const std::size_t part = part_of(number);
    const auto* blocks = load(part);
    const std::uint32_t place = number - parts_[part].first;
    return blocks == nullptr || place >= blocks->size() ? nullptr : &(*blocks)[place];
}

std::optional<std::span<const double>> RecordedProgram::place_before(std::uint32_t number) const {
    if (ends_before(number)) { return end_mm_; }
    const std::size_t part = part_of(number);
    const auto* blocks = load(part);
    if (blocks == nullptr) { return std::nullopt; }
    for (std::size_t k = std::min<std::size_t>(number - parts_[part].first, blocks->size()); k > 0; --k) {
        if (const auto* move = std::get_if<ProgramMove>(&(*blocks)[k - 1].action)) { return move->target_mm; }
    }
    return parts_[part].at_mm;
}

}  // namespace lockstep::analysis
