#include "clients/export/export.hpp"

#include <memory>
#include <utility>

#include "clients/export/csv_table.hpp"
#include "clients/export/mcap_file.hpp"
#include "clients/export/record_check.hpp"
#include "services/files/unfinished_file.hpp"
#include "services/record/reading/log_read.hpp"
#include "services/record/reading/log_step.hpp"

namespace lockstep::exporting {
namespace {

using analysis::LogPlace;

/// Converts every exported message to a sample.
class Samples final : public analysis::LogListener {
public:
    using OnSample = std::function<void(const Sample&)>;
    explicit Samples(OnSample on_sample) : on_sample_(std::move(on_sample)) {}

    void on_steps(const step_batch_t& message, LogPlace /*place*/) override { check_.saw(RecordKind::Steps, message); }
    void on_run(const run_t& message, LogPlace /*place*/) override { check_.saw(RecordKind::Run, message); }
    void on_position(const axis_position_t& message, LogPlace /*place*/) override {
        take(RecordKind::Position, message);
    }
    void on_health(const axis_health_t& message, LogPlace /*place*/) override { take(RecordKind::Health, message); }
    void on_channel(const channel_event_t& message, LogPlace /*place*/) override {
        take(RecordKind::Channels, message);
    }
    void on_job(const analysis::RecordedJob& message, LogPlace /*place*/) override {
        check_.take_machine(message.config);
        take(RecordKind::Job, message);
    }
    void on_event(const program_event_t& message, LogPlace /*place*/) override { take(RecordKind::Event, message); }
    void on_program_part(const program_part_t& message, LogPlace /*place*/) override {
        check_.saw(RecordKind::ProgramPart, message);
    }
    void on_mark(const analysis::RecordedMark& message, LogPlace /*place*/) override { check_.take(message); }
    void on_foreign(std::string_view /*channel*/) override {}
    void on_damage(LogPlace /*place*/, std::string /*what*/) override { ++damages_; }

    std::int64_t samples() const { return samples_; }
    std::int64_t damages() const { return damages_; }
    /// Call once, at the end.
    analysis::RecordState record() { return check_.finish(); }

private:
    void take(RecordKind kind, const auto& message) {
        check_.saw(kind, message);
        if (!analysis::is_countable(message.utime)) {
            ++damages_;
            return;
        }
        ++samples_;
        on_sample_(sample_of(message));
    }

    OnSample on_sample_;
    std::int64_t samples_ = 0;
    std::int64_t damages_ = 0;
    RecordCheck check_;
};

std::expected<std::unique_ptr<SampleWriter>, std::string> open_csv(const std::filesystem::path& log,
                                                                   const std::filesystem::path& to) {
    Columns columns;
    Samples names([&](const Sample& sample) { columns.add(sample); });
    if (const auto read = analysis::read_log(log, names); !read) { return std::unexpected(read.error()); }
    auto file = analysis::CsvFile::create(to, columns.header());
    if (!file) { return std::unexpected(file.error()); }
    return std::make_unique<CsvTable>(std::move(columns), std::move(*file));
}

std::expected<std::unique_ptr<SampleWriter>, std::string> open_mcap(const std::filesystem::path& to) {
    auto file = McapFile::create(to);
    if (!file) { return std::unexpected(file.error()); }
    return std::make_unique<McapFile>(std::move(*file));
}

}  // namespace

std::expected<Exported, std::string> export_log(const std::filesystem::path& log, const std::filesystem::path& to,
                                                Format format, const std::function<void(double)>& progress) {
    UnfinishedFile file(to);
    auto writer = format == Format::Csv ? open_csv(log, file.unfinished()) : open_mcap(file.unfinished());
    if (!writer) { return std::unexpected(file.named(writer.error())); }
    Samples samples([&](const Sample& sample) { (*writer)->write(sample); });
    if (const auto read = analysis::read_log(log, samples, progress); !read) { return std::unexpected(read.error()); }
    if (samples.samples() == 0) {
        return std::unexpected(log.string() + ": it contains no position, health or job to export");
    }
    if (const auto closed = (*writer)->close(); !closed) { return std::unexpected(file.named(closed.error())); }
    if (const auto kept = file.keep(); !kept) { return std::unexpected(kept.error()); }
    return Exported{samples.samples(), (*writer)->left_out(), samples.damages(), samples.record()};
}

}  // namespace lockstep::exporting
