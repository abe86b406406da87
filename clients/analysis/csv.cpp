#include "clients/analysis/csv.hpp"

#include <array>
#include <charconv>

namespace lockstep::analysis {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 20;

}  // namespace

std::string csv_text(std::string_view text) {
    if (text.find_first_of(",\"\r\n") == text.npos) { return std::string(text); }
    std::string quoted = "\"";
    for (const char c : text) { quoted += c == '"' ? std::string("\"\"") : std::string(1, c); }
    return quoted + '"';
}

std::expected<CsvFile, std::string> CsvFile::create(const std::filesystem::path& path, std::string_view header) {
    auto out = OutputFile::create(path);
    if (!out) { return std::unexpected(out.error()); }
    CsvFile file(std::move(*out));
    file.buffer_.reserve(kBuffer + 128);
    file.buffer_.append(header).push_back('\n');
    return file;
}

template <typename Number>
CsvFile& CsvFile::append(Number value) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
    buffer_.append(text.data(), error == std::errc{} ? end : text.data());
    buffer_.push_back(',');
    return *this;
}

CsvFile& CsvFile::cell(std::int64_t value) { return append(value); }
CsvFile& CsvFile::cell(double value) { return append(value); }

CsvFile& CsvFile::cell(std::string_view text) {
    buffer_.append(csv_text(text)).push_back(',');
    return *this;
}

CsvFile& CsvFile::empty_cell() {
    buffer_.push_back(',');
    return *this;
}

void CsvFile::end_line() {
    buffer_.back() = '\n';
    if (buffer_.size() >= kBuffer) { flush(); }
}

void CsvFile::flush() {
    out_.write(buffer_);
    buffer_.clear();
}

std::expected<void, std::string> CsvFile::close() {
    flush();
    return out_.close();
}

void StepCsv::on_batch(const StepBatch& batch) {
    std::int64_t position = batch.position_before_steps;
    for (const StepEdge& edge : batch.steps) {
        position += edge.direction;
        file_.cell(edge.tick.value).cell(position).end_line();
    }
}

}  // namespace lockstep::analysis
