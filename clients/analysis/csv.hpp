// Writes lines of integers, decimals and texts to a file, fast.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <string>
#include <string_view>

#include "services/files/output_file.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::analysis {

/// The text of a cell, in quotes if it contains a comma, a quote or a line end (RFC 4180).
std::string csv_text(std::string_view text);

/// A CSV file. Integers are written exactly, decimals in the shortest form that reads back the same.
class CsvFile {
public:
    /// Creates or replaces the file with its header line. The error names the file and the reason.
    static std::expected<CsvFile, std::string> create(const std::filesystem::path& path, std::string_view header);

    CsvFile& cell(std::int64_t value);
    CsvFile& cell(double value);
    CsvFile& cell(std::string_view text);
    CsvFile& empty_cell();
    void end_line();
    /// Writes what is buffered. The error names the file and the reason.
    std::expected<void, std::string> close();

private:
    explicit CsvFile(OutputFile out) : out_(std::move(out)) {}
    template <typename Number>
    CsvFile& append(Number value);
    void flush();

    OutputFile out_;
    std::string buffer_;
};

/// `steps_<axis>.csv`: the tick of each step and the position after it, in steps.
class StepCsv final : public StepListener {
public:
    static constexpr std::string_view kHeader = "tick,position";

    explicit StepCsv(CsvFile file) : file_(std::move(file)) {}
    void on_batch(const StepBatch& batch) override;
    std::expected<void, std::string> close() { return file_.close(); }

private:
    CsvFile file_;
};

}  // namespace lockstep::analysis
