// A log under construction: it gets its name when it is complete, so that an interrupted run leaves no partial log.
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
    /// `force`: replaces any file; without it only a log is replaced. Error: why not, and the
    /// remedy.
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
