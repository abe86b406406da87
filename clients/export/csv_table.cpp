#include "clients/export/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::exporting {
namespace {

/// "/mill/X/position" and "position_mm" make "mill/X/position_mm".
std::string column_name(const Topic& topic, std::string_view signal) {
    return topic.substr(1, topic.rfind('/')) + std::string(signal);
}

void write_cell(analysis::CsvFile& file, const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        file.cell(std::string_view(*text));
    } else if (const auto* number = std::get_if<std::int64_t>(&value)) {
        file.cell(*number);
    } else {
        file.cell(std::get<double>(value));
    }
}

bool is_finite(const Value& value) {
    const auto* number = std::get_if<double>(&value);
    return number == nullptr || std::isfinite(*number);
}

}  // namespace

void Columns::add(const Sample& sample) {
    utime_begin_ = std::min(utime_begin_.value_or(sample.utime), sample.utime);
    if (first_.size() == kMaxTopics || !first_.try_emplace(sample.topic, names_.size()).second) { return; }
    for (const Signal& signal : sample.signals) { names_.push_back(column_name(sample.topic, signal.name)); }
}

std::string Columns::header() const {
    std::string text = "time_s";
    for (const std::string& name : names_) { text += "," + analysis::csv_text(name); }
    return text;
}

std::optional<std::size_t> Columns::of(const Topic& topic) const {
    const auto found = first_.find(topic);
    return found != first_.end() ? std::optional(found->second) : std::nullopt;
}

void CsvTable::write(const Sample& sample) {
    const auto first = columns_.of(sample.topic);
    if (!first || (written_up_to_ && sample.utime <= *written_up_to_)) {
        ++left_out_;
        return;
    }
    Row& row = rows_[sample.utime];
    for (std::size_t i = 0; i < sample.signals.size(); ++i) {
        if (is_finite(sample.signals[i].value)) { row[*first + i] = sample.signals[i].value; }
    }
    while (rows_.rbegin()->first - rows_.begin()->first > kPatience_us || rows_.size() > kMaxRowsHeld) {
        write_first_row();
    }
}

void CsvTable::write_first_row() {
    const auto [utime, row] = *rows_.begin();
    file_.cell(static_cast<double>(utime - columns_.utime_begin()) / 1e6);
    for (std::size_t column = 0; column < columns_.count(); ++column) {
        const auto cell = row.find(column);
        cell != row.end() ? write_cell(file_, cell->second) : void(file_.empty_cell());
    }
    file_.end_line();
    written_up_to_ = utime;
    rows_.erase(rows_.begin());
}

std::expected<void, std::string> CsvTable::close() {
    while (!rows_.empty()) { write_first_row(); }
    return file_.close();
}

}  // namespace lockstep::exporting
