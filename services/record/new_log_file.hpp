// A log in the making: it gets its name when it is whole, so that a run that breaks off leaves no half of one.
#pragma once

#include <expected>
#include <filesystem>
#include <memory>
#include <string>

#include "services/record/sinks.hpp"

namespace lockstep {

class NewLogFile {
public:
    /// `force`: what stands there may be replaced whatever it is; without it only a log may. Error: why not, and the
    /// remedy.
    static std::expected<NewLogFile, std::string> begin(const std::filesystem::path& path, bool force);

    NewLogFile(NewLogFile&& other) noexcept;
    NewLogFile& operator=(NewLogFile&&) = delete;
    /// What was not kept is gone.
    ~NewLogFile();

    RecordSink& sink() { return *sink_; }
    /// The log stands under its name now. Error: the disk is full or gone.
    std::expected<void, std::string> keep();

private:
    NewLogFile(std::filesystem::path path, std::filesystem::path unfinished, LogWriter writer);

    std::filesystem::path path_;
    std::filesystem::path unfinished_;  // empty: nothing to clear away
    std::unique_ptr<LogSink> sink_;
};

}  // namespace lockstep
