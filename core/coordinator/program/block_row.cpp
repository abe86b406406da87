#include "core/coordinator/program/block_row.hpp"

#include <algorithm>
#include <cstdint>

#include "core/if_positive.hpp"
#include "core/indices.hpp"

namespace lockstep {
namespace {

enum class RowKind : std::uint8_t { Move, Rapid, Arc, Dwell, Pause, Settle, Event, Probe };

// Several whole numbers are packed into one double, which is exact up to 2^53.
constexpr std::int64_t kRowKinds = 8;
constexpr std::int64_t kModes = 4;
constexpr std::int64_t kAxesMost = 64;
static_assert(kMaxAxes <= kAxesMost && 2 * kModes * 2 * kAxesMost * kAxesMost * kMaxTurns < 1LL << 53);

struct Packed {
    std::int64_t value = 0;

    void add(std::int64_t number, std::int64_t below) { value = value * below + number; }
    /// Takes the numbers in the reverse order of add().
    std::int64_t take(std::int64_t below) {
        const std::int64_t number = value % below;
        value /= below;
        return number;
    }
};

std::int64_t details_of(const ProgramMove& move) {
    Packed details;
    if (move.arc) {
        details.add(move.arc->turns, kMaxTurns + 1);
        details.add(static_cast<std::int64_t>(move.arc->first), kAxesMost);
        details.add(static_cast<std::int64_t>(move.arc->second), kAxesMost);
        details.add(move.arc->is_clockwise ? 1 : 0, 2);
    }
    details.add(static_cast<std::int64_t>(move.mode), kModes);
    details.add(move.is_feed_fixed ? 1 : 0, 2);
    return details.value;
}

struct Row {
    RowKind kind = RowKind::Pause;
    double amount = 0;
    std::int64_t details = 0;
    double other = 0;
    double centre[2] = {0, 0};
};

struct RowMaker {
    PauseTexts& texts;

    Row operator()(const ProgramMove& move) const {
        Row row{.kind = move.arc     ? RowKind::Arc
                        : move.rapid ? RowKind::Rapid
                                     : RowKind::Move,
                .amount = move.feed_mm_s,
                .details = details_of(move),
                .other = move.tolerance_mm};
        if (move.arc) { row.centre[0] = move.arc->centre_first_mm; }
        if (move.arc) { row.centre[1] = move.arc->centre_second_mm; }
        return row;
    }
    Row operator()(const Dwell& dwell) const { return {.kind = RowKind::Dwell, .amount = dwell.seconds}; }
    Row operator()(const Pause& pause) const {
        Row row{.kind = RowKind::Pause,
                .amount = static_cast<double>(pause.wait ? pause.wait->input : pause.tool),
                .details = static_cast<std::int64_t>(pause.reason),
                .other = static_cast<double>(texts.keep(pause.text))};
        if (pause.wait) { row.centre[0] = static_cast<double>(pause.wait->mode); }
        if (pause.wait) { row.centre[1] = pause.wait->seconds; }
        return row;
    }
    Row operator()(const Settle&) const { return {.kind = RowKind::Settle}; }
    Row operator()(const Probe& probe) const {
        return {.kind = RowKind::Probe,
                .amount = static_cast<double>(probe.input),
                .details = (probe.opens ? 1 : 0) + (probe.must_touch ? 2 : 0)};
    }
    Row operator()(const ProgramEvent& event) const {
        return {.kind = RowKind::Event,
                .amount = event.value,
                .details = static_cast<std::int64_t>(event.kind),
                .other = static_cast<double>(event.index)};
    }
};

void read_move(RowKind kind, std::span<const double> row, ProgramMove& move) {
    const std::span<const double> place = place_of_row(row);
    Packed details{static_cast<std::int64_t>(row[2])};
    move.target_mm.assign(place.begin(), place.end());
    move.feed_mm_s = row[1];
    move.rapid = kind == RowKind::Rapid;
    move.is_feed_fixed = details.take(2) != 0;
    move.mode = static_cast<PathMode>(details.take(kModes));
    move.tolerance_mm = row[3];
    move.arc.reset();
    if (kind != RowKind::Arc) { return; }
    ArcShape& arc = move.arc.emplace(ArcShape{.centre_first_mm = row[4], .centre_second_mm = row[5]});
    arc.is_clockwise = details.take(2) != 0;
    arc.second = static_cast<std::size_t>(details.take(kAxesMost));
    arc.first = static_cast<std::size_t>(details.take(kAxesMost));
    arc.turns = static_cast<std::int32_t>(details.take(kMaxTurns + 1));
}

Pause pause_of(std::span<const double> row, const PauseTexts& texts) {
    const auto number = static_cast<std::int32_t>(row[1]);
    Pause pause{.reason = static_cast<PauseReason>(row[2]), .text = texts.text_of(static_cast<std::int64_t>(row[3]))};
    if (pause.reason != PauseReason::Input) {
        pause.tool = number;
    } else {
        pause.wait = InputWait{number, static_cast<InputMode>(row[4]), row[5]};
    }
    return pause;
}

Probe probe_of(std::span<const double> row) {
    const auto details = static_cast<int>(row[2]);
    return {static_cast<std::int32_t>(row[1]), (details & 1) != 0, (details & 2) != 0};
}

Block other_block(RowKind kind, std::optional<std::int32_t> line, std::span<const double> row,
                  const PauseTexts& texts) {
    switch (kind) {
        case RowKind::Dwell: return {line, Dwell{row[1]}};
        case RowKind::Pause: return {line, pause_of(row, texts)};
        case RowKind::Settle: return {line, Settle{}};
        case RowKind::Probe: return {line, probe_of(row)};
        default: break;
    }
    return {line, ProgramEvent{static_cast<ProgramEvent::Kind>(row[2]), static_cast<std::int32_t>(row[3]), row[1]}};
}

}  // namespace

std::int64_t PauseTexts::keep(const std::string& text) {
    if (text.empty()) { return 0; }
    const auto known = std::ranges::find(texts_, text);
    if (known != texts_.end()) { return known - texts_.begin() + 1; }
    if (texts_.size() == kMost) { return 0; }
    texts_.push_back(text.substr(0, kMaxPauseText));
    return std::ssize(texts_);
}

const std::string& PauseTexts::text_of(std::int64_t number) const {
    static const std::string kNone;
    return number == 0 ? kNone : texts_[static_cast<std::size_t>(number - 1)];
}

void append_row(const Block& block, std::span<const double> place_mm, PauseTexts& texts, std::vector<double>& rows) {
    const Row row = std::visit(RowMaker{texts}, block.action);
    rows.push_back(static_cast<double>(kRowKinds * block.line.value_or(0) + static_cast<std::int64_t>(row.kind)));
    rows.insert(rows.end(), {row.amount, static_cast<double>(row.details), row.other, row.centre[0], row.centre[1]});
    rows.insert(rows.end(), place_mm.begin(), place_mm.end());
}

const Block& RowReader::read(std::span<const double> row, const PauseTexts& texts) {
    Packed head{static_cast<std::int64_t>(row[0])};
    const auto kind = static_cast<RowKind>(head.take(kRowKinds));
    const auto line = if_positive(static_cast<std::int32_t>(head.value));
    if (kind != RowKind::Move && kind != RowKind::Rapid && kind != RowKind::Arc) {
        return other_ = other_block(kind, line, row, texts);
    }
    move_.line = line;
    read_move(kind, row, std::get<ProgramMove>(move_.action));
    return move_;
}

}  // namespace lockstep
