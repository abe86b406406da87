#include "clients/planning/program_text.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {

bool does_probe(const Program& program) {
    return std::ranges::any_of(program.blocks,
                               [](const Block& block) { return std::holds_alternative<Probe>(block.action); });
}

ProgramText::ProgramText(LineReader lines, const GcodeSetup& setup, std::string_view text)
    : lines_(std::move(lines)), gcode_(setup, text), head_(gcode_.head()), at_mm_(head_.start_mm) {}

const Block* ProgramText::block(std::uint32_t number) const {
    if (ends_before(number) || number < first_) { return nullptr; }
    const auto passed = std::min<std::size_t>(number - first_, blocks_.size());
    for (std::size_t k = 0; k < passed; ++k, blocks_.pop_front()) {
        if (auto* move = std::get_if<ProgramMove>(&blocks_.front().action)) { at_mm_ = std::move(move->target_mm); }
    }
    first_ = number;
    return &blocks_.front();
}

bool ProgramText::ends_before(std::uint32_t number) const {
    while (errors_.empty() && number >= first_ + blocks_.size() && read_line()) {}
    return number >= first_ + blocks_.size();
}

void ProgramText::pass_blocks(const std::function<bool(std::vector<Block>& blocks)>& take) {
    bool goes_on = true;
    pass_ = [&](std::vector<Block>& blocks) {
        passed_ += blocks.size();
        goes_on = goes_on && take(blocks);
        blocks.clear();
    };
    gcode_.pass_on(pass_);
    while (goes_on && errors_.empty() && read_line()) {}
    gcode_.pass_on({});
    pass_ = {};
}

const Diagnostics& ProgramText::errors() {
    while (!errors_.empty() && errors_.size() < kMaxGcodeErrors && read_line()) { blocks_.clear(); }
    return errors_;
}

void ProgramText::touched(const ProbeTouch& touch) {
    if (const auto done = gcode_.touched(touch); !done) { report(done.error()); }
    head_ = gcode_.head();
    at_mm_ = head_.start_mm;
    blocks_.clear();
    first_ = 0;
    take_blocks();
}

void ProgramText::take_blocks() const {
    gcode_.take_blocks(taken_);
    if (!errors_.empty()) { taken_.clear(); }
    if (pass_) { pass_(taken_); }
    std::ranges::move(taken_, std::back_inserter(blocks_));
    std::ranges::move(gcode_.take_notes(), std::back_inserter(notes_));
}

/// Returns false if no line is left, or none can be read before the touch is known.
bool ProgramText::read_line() const {
    if (is_over_ || awaits_touch()) { return false; }
    const auto next = lines_.next();
    if (!next) {
        errors_.push_back({.line = line_ + 1, .column = 1, .message = next.error()});
        is_over_ = true;
        return false;
    }
    if (next->state == LineReader::State::Waits) { return true; }
    const bool is_end = next->state == LineReader::State::Ends;
    const auto done = is_end ? gcode_.finish() : gcode_.take(next->line, ++line_);
    if (!done) { report(done.error()); }
    take_blocks();
    is_over_ = is_end || gcode_.is_ended();
    return !is_over_;
}

/// An error that every later line would bring again is reported once.
void ProgramText::report(const GcodeError& error) const {
    if (error.repeats && std::exchange(has_repeated_, true)) { return; }
    errors_.push_back({.line = error.line, .column = error.column, .message = error.message});
}

}  // namespace lockstep
