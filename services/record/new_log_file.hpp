// A log in the making: it gets its name when it is whole, so that a run that breaks off leaves no half of one.
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
    /// `force`: what stands there may be replaced whatever it is; without it only a log may. Error: why not, and the
    /// remedy.
    static std::expected<NewLogFile, std::string> begin(const std::filesystem::path& path, bool force);

    RecordSink& sink() { return *sink_; }
    /// The log stands under its name now. Error: the disk is full or gone.
    std::expected<void, std::string> keep();

private:
    NewLogFile(UnfinishedFile file, LogWriter writer);

    UnfinishedFile file_;
    std::unique_ptr<LogSink> sink_;
};

}  // namespace lockstep
