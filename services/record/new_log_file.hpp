// A log that gets its name only when it is complete, so that an interrupted run leaves no partial log.
#pragma once

#include <expected>
#include <filesystem>
#include <memory>
#include <string>

#include "services/files/unfinished_file.hpp"
#include "services/record/sinks.hpp"

namespace lockstep {

class NewLogFile {
public:
    /// With `force` it replaces any file, otherwise only a log or an empty file. Error: why it cannot, and the remedy.
    static std::expected<NewLogFile, std::string> begin(const std::filesystem::path& path, bool force);

    RecordSink& sink() { return *sink_; }
    /// Gives the log its name. Error: the disk is full or failed.
    std::expected<void, std::string> keep();

private:
    NewLogFile(UnfinishedFile file, LogWriter writer);

    UnfinishedFile file_;
    std::unique_ptr<LogSink> sink_;
};

}  // namespace lockstep
