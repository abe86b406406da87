#include "core/coordinator/program/known_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/arc_path.hpp"

namespace lockstep {

std::expected<KnownProgram, ProgramCut> KnownProgram::begin(const MachineConfig& machine, ProgramHead head,
                                                            std::unique_ptr<RowStore> rows) {
    auto axes = ProgramPlanner(machine).axes_of(head.axes);
    if (!axes) { return std::unexpected(ProgramCut{axes.error().fault, std::nullopt, axes.error().text}); }
    return KnownProgram(machine, std::move(head), *std::move(axes), std::move(rows));
}

KnownProgram::KnownProgram(const MachineConfig& machine, ProgramHead head, std::vector<AxisIndex> axes,
                           std::unique_ptr<RowStore> rows)
    : planner_(machine),
      head_(std::move(head)),
      axes_(std::move(axes)),
      rows_(std::move(rows)),
      times_(machine),
      at_mm_(head_.start_mm),
      legs_{0},
      row_(row_width(head_)) {
    for (std::size_t i = 0; i < machine.axes.size(); ++i) { zero_.append(0); }
}

std::expected<void, ProgramCut> KnownProgram::check(const Block& block, std::span<const double> from_mm) const {
    if (known_ > std::numeric_limits<std::uint32_t>::max() - kMaxProgramBlocks) {
        return std::unexpected(ProgramCut{FaultCode::BadProgram, block.line,
                                          "the program has more than 4,000 million blocks; split it in two"});
    }
    const auto* pause = std::get_if<Pause>(&block.action);
    if (pause != nullptr && pause->wait && planner_.input(InputUse::Program, pause->wait->input) == nullptr) {
        return std::unexpected(ProgramCut{FaultCode::BadProgram, block.line,
                                          "input " + std::to_string(pause->wait->input) +
                                              " is not configured on this machine; remove M66, or write input { } "
                                              "with this number in the machine's file"});
    }
    const auto* move = std::get_if<ProgramMove>(&block.action);
    if (move == nullptr) { return {}; }
    if (move->target_mm.size() != axes_.size()) {
        return std::unexpected(ProgramCut{FaultCode::BadProgram, block.line,
                                          "the target has " + std::to_string(move->target_mm.size()) +
                                              " positions for " + std::to_string(axes_.size()) + " axes"});
    }
    const auto to = planner_.target(*move, axes_, zero_, block.line);
    if (!to) { return std::unexpected(ProgramCut{to.error().fault, block.line, to.error().text}); }
    if (!move->arc) { return {}; }
    if (const auto runs = planner_.check_arc(*move, axes_, from_mm, block.line); !runs) {
        return std::unexpected(ProgramCut{runs.error().fault, block.line, runs.error().text});
    }
    return {};
}

void KnownProgram::take(const Block& block) {
    if (const auto* move = std::get_if<ProgramMove>(&block.action)) {
        std::vector<double> way(zero_.size());
        for (std::size_t i = 0; i < axes_.size(); ++i) { way[axes_[i]] = move->target_mm[i] - at_mm_[i]; }
        const std::optional<double> feed_mm_s = move->feed_for(1);
        if (move->arc) {
            const ArcPath arc(*move->arc, at_mm_, move->target_mm);
            times_.add_arc(arc, {axes_[move->arc->first], axes_[move->arc->second]}, way, feed_mm_s);
        } else {
            times_.add_move(way, feed_mm_s);
        }
        at_mm_ = move->target_mm;
    } else if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
        times_.add_dwell(dwell->seconds);
    } else if (std::holds_alternative<ProgramEvent>(block.action)) {
        times_.add_dwell(0);
    } else {
        times_.add_rest();
        legs_.push_back(known_ + static_cast<std::uint32_t>(taken_.size() / row_.size()) + 1);
        if (legs_.size() > kLegsKept) { legs_.pop_front(); }
    }
    append_row(block, at_mm_, texts_, taken_);
    last_line_ = block.line;
}

std::expected<void, ProgramCut> KnownProgram::append(std::span<const Block> blocks) {
    const auto taken = take_all(blocks);
    if (!taken) { cut(taken.error()); }
    return taken;
}

std::expected<void, ProgramCut> KnownProgram::take_all(std::span<const Block> blocks) {
    std::span<const double> from = at_mm_;
    std::uint32_t events = events_together_;
    ProbeCheck probes = probes_;
    for (const Block& block : blocks) {
        if (auto fits = check(block, from); !fits) { return fits; }
        if (const auto probed = probes.next(block, planner_.machine(), axes_, from); !probed) {
            return std::unexpected(ProgramCut{probed.error().fault, block.line, probed.error().text});
        }
        events = std::holds_alternative<ProgramEvent>(block.action) ? events + 1 : 0;
        if (events > kMaxEventsTogether) {
            return std::unexpected(ProgramCut{FaultCode::BadProgram, block.line,
                                              "the program has more than " + std::to_string(kMaxEventsTogether) +
                                                  " events without a move between them; remove some"});
        }
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { from = move->target_mm; }
    }
    taken_.clear();
    const std::optional<std::int32_t> line_before = last_line_;
    for (const Block& block : blocks) { take(block); }
    if (const auto kept = rows_->append(taken_); !kept) {
        last_line_ = line_before;
        return std::unexpected(ProgramCut{FaultCode::ProgramNotKept, blocks.front().line, kept.error()});
    }
    known_ += static_cast<std::uint32_t>(blocks.size());
    events_together_ = events;
    probes_ = probes;
    return {};
}

void KnownProgram::cut(ProgramCut cut) {
    if (!is_open_) { return; }
    is_open_ = false;
    cut_ = std::move(cut);
}

bool KnownProgram::read(std::uint32_t number) const { return number < known_ && rows_->read(number, row_); }

const Block* KnownProgram::block(std::uint32_t number) const {
    return read(number) ? &reader_.read(row_, texts_) : nullptr;
}

std::optional<std::span<const double>> KnownProgram::place_before(std::uint32_t number) const {
    if (number == 0) { return head_.start_mm; }
    if (!read(number - 1)) { return std::nullopt; }
    return place_of_row(row_);
}

std::optional<Program> KnownProgram::whole() const {
    Program program{.name = head_.name, .axes = head_.axes, .start_mm = head_.start_mm, .blocks = {}};
    for (std::uint32_t number = 0; number < known_; ++number) {
        const Block* const block = this->block(number);
        if (block == nullptr) { return std::nullopt; }
        program.blocks.push_back(*block);
    }
    return program;
}

std::optional<std::uint32_t> KnownProgram::leg_of(std::uint32_t number) const {
    const auto behind = std::ranges::upper_bound(legs_, number);
    return behind == legs_.begin() ? std::nullopt : std::optional(*(behind - 1));
}

/// The unknown part of the program is assumed to take as long for its share as the known part.
double KnownProgram::seconds_from(const PathPlace& place) const {
    const double left = times_.seconds_from(place);
    if (!is_open_ || !known_share_) { return left; }
    return left + times_.seconds() * (1 / std::min(*known_share_, 1.0) - 1);
}

}  // namespace lockstep
