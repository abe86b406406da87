#include "tests/records/record.hpp"

#include <unistd.h>

#include <stdexcept>

#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::records {

void write_record(const Record& record, const std::filesystem::path& path) {
    auto writer = LogWriter::open(path);
    if (!writer) { throw std::runtime_error(writer.error()); }
    bool is_written = true;
    for (const Message& message : record) { is_written &= writer->write(message.channel, message.utime, message.data); }
    if (!writer->flush() || !is_written) { throw std::runtime_error(path.string() + " cannot be written"); }
}

Record read_record(const std::filesystem::path& path) {
    auto reader = LogReader::open(path);
    if (!reader) { throw std::runtime_error(reader.error()); }
    Record record;
    while (auto event = reader->next().value()) {
        record.push_back({std::string(event->channel), event->utime, {event->data.begin(), event->data.end()}});
    }
    return record;
}

namespace {

/// Exists as long as the process.
struct RecordFolder {
    RecordFolder() { std::filesystem::create_directories(path); }
    ~RecordFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    RecordFolder(const RecordFolder&) = delete;
    RecordFolder& operator=(const RecordFolder&) = delete;

    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("lockstep_records_" + std::to_string(getpid()));
};

}  // namespace

std::filesystem::path record_folder() {
    static const RecordFolder folder;
    return folder.path;
}

}  // namespace lockstep::records
