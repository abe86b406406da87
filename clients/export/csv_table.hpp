// One table for the whole log, for PlotJuggler and spreadsheets. It has a row for each instant with a message. The
// first column is time_s, then follows one column for each signal ("mill/X/position_mm"). A cell is empty if there was
// no value at that instant. time_s counts from the first sample of the log and rises strictly from row to row.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "clients/analysis/csv.hpp"
#include "clients/export/sample_writer.hpp"

namespace lockstep::exporting {

/// The columns of the table, collected in a first pass over the log.
class Columns {
public:
    static constexpr std::size_t kMaxTopics = 1024;

    void add(const Sample& sample);
    std::string header() const;
    std::size_t count() const { return names_.size(); }
    /// The first column of a topic; nullopt if the topic was not added.
    std::optional<std::size_t> of(const Topic& topic) const;
    /// The time of the earliest sample.
    std::int64_t utime_begin() const { return utime_begin_.value_or(0); }

private:
    std::map<Topic, std::size_t> first_;
    std::vector<std::string> names_;
    std::optional<std::int64_t> utime_begin_;
};

class CsvTable final : public SampleWriter {
public:
    /// A row is written once a sample is this much newer; samples that come after their row was written are left out.
    static constexpr std::int64_t kPatience_us = 2'000'000;
    static constexpr std::size_t kMaxRowsHeld = 1 << 16;

    CsvTable(Columns columns, analysis::CsvFile file) : columns_(std::move(columns)), file_(std::move(file)) {}

    void write(const Sample& sample) override;
    std::expected<void, std::string> close() override;
    std::int64_t left_out() const override { return left_out_; }

private:
    using Row = std::map<std::size_t, Value>;  // by column
    void write_first_row();

    Columns columns_;
    analysis::CsvFile file_;
    std::map<std::int64_t, Row> rows_;  // by utime
    std::optional<std::int64_t> written_up_to_;
    std::int64_t left_out_ = 0;
};

}  // namespace lockstep::exporting
