// The reports and incident files of a machine on this host.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/web/http/message.hpp"
#include "clients/web/request/problem.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

class ReportFiles {
public:
    static constexpr std::size_t kMostFiles = 200;
    static constexpr std::uintmax_t kMost_bytes = 64U * 1024 * 1024;

    /// `reports`: the directory of report pages, which may be missing.
    ReportFiles(std::filesystem::path reports, std::filesystem::path incidents)
        : reports_(std::move(reports)), incidents_(std::move(incidents)) {}

    /// Reads the directories. The result has the schema Reports.
    Json list() const;
    /// Returns the file with this name in the list. Fails with 404 if there is none.
    std::expected<Response, Problem> read(const std::string& name) const;

private:
    struct File {
        std::filesystem::path path;
        bool is_report = false;
        std::filesystem::file_time_type modified;
        std::uintmax_t bytes = 0;
    };
    std::vector<File> files() const;

    std::filesystem::path reports_;
    std::filesystem::path incidents_;
};

}  // namespace lockstep::web
