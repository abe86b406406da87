#include "clients/web/api/report_files.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <system_error>

#include "clients/text/format.hpp"

namespace lockstep::web {
namespace {

/// A report contains its script and its styles. It gets a separate origin and no network.
constexpr const char* kReportPolicy =
    "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data:; font-src data:; frame-ancestors 'none'";

std::string time_text(std::filesystem::file_time_type time) {
    const auto utc = std::filesystem::file_time_type::clock::to_sys(time);
    return utc_text(std::chrono::time_point_cast<std::chrono::system_clock::duration>(utc));
}

}  // namespace

std::vector<ReportFiles::File> ReportFiles::files() const {
    std::vector<File> files;
    for (const auto& [directory, is_report] : {std::pair{reports_, true}, std::pair{incidents_, false}}) {
        std::error_code error;
        for (std::filesystem::directory_iterator at(directory, error), end; !error && at != end; at.increment(error)) {
            std::error_code ignored;
            const bool fits = !is_report || at->path().extension() == ".html";
            if (!fits || !at->is_regular_file(ignored) || at->is_symlink(ignored)) { continue; }
            files.push_back({at->path(), is_report, at->last_write_time(ignored), at->file_size(ignored)});
        }
    }
    std::ranges::sort(files, std::greater{}, &File::modified);
    if (files.size() > kMostFiles) { files.resize(kMostFiles); }
    return files;
}

Json ReportFiles::list() const {
    Json list = Json::array();
    for (const File& file : files()) {
        list.push_back({{"name", file.path.filename().string()},
                        {"kind", file.is_report ? "report" : "incident"},
                        {"bytes", file.bytes},
                        {"modified", time_text(file.modified)}});
    }
    return {{"files", list}};
}

std::expected<Response, Problem> ReportFiles::read(const std::string& name) const {
    const auto all = files();
    const auto found = std::ranges::find_if(all, [&](const File& file) { return file.path.filename() == name; });
    if (found == all.end() || found->bytes > kMost_bytes) {
        return std::unexpected(Problem{.status = 404,
                                       .code = "no-such-file",
                                       .title = "there is no such file",
                                       .detail = "'" + name.substr(0, 200) + "' is not one of the machine's reports",
                                       .place = "path",
                                       .limit = "a name in GET /api/reports",
                                       .remedy = "read the list again"});
    }
    std::ifstream stream(found->path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    Response response{.body = std::move(bytes), .headers = {{"Cache-Control", "private, no-cache"}}};
    if (found->is_report) {
        response.headers.emplace_back("Content-Type", "text/html; charset=utf-8");
        response.headers.emplace_back("Content-Security-Policy", kReportPolicy);
    } else {
        response.headers.emplace_back("Content-Type", "application/octet-stream");
        response.headers.emplace_back("Content-Disposition", "attachment");
    }
    return response;
}

}  // namespace lockstep::web
