// The reports and incident files that a page shows.
#include "clients/web/api/report_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/temporary_directory.hpp"

namespace lockstep::web {
namespace {

class Files : public testing::Test {
protected:
    void SetUp() override {
        for (const auto& part : {reports, incidents}) { std::filesystem::create_directory(part); }
    }
    static void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        const Json list = files.list()["files"];
        for (const Json& file : list) { names.push_back(file["name"]); }
        return names;
    }
    static std::string header(const Response& response, const std::string& name) {
        for (const auto& [key, value] : response.headers) {
            if (key == name) { return value; }
        }
        return "";
    }

    TemporaryDirectory directory;
    std::filesystem::path reports = directory.path() / "reports";
    std::filesystem::path incidents = directory.path() / "incidents";
    ReportFiles files{reports, incidents};
};

TEST_F(Files, AreListedTheNewestFirst) {
    write(reports / "old.html", "old");
    write(incidents / "a.incident", "12345");
    std::filesystem::last_write_time(reports / "old.html",
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
    EXPECT_EQ(names(), (std::vector<std::string>{"a.incident", "old.html"}));
    const Json first = files.list()["files"][0];
    EXPECT_EQ(first["kind"], "incident");
    EXPECT_EQ(first["bytes"], 5);
}

TEST_F(Files, AreNoneWhereTheirDirectoriesAreMissing) {
    EXPECT_EQ(ReportFiles("/nonexistent/a", "/nonexistent/b").list(), (Json{{"files", Json::array()}}));
}

TEST_F(Files, OfReportsArePagesAlone) {
    write(reports / "notes.txt", "private");
    std::filesystem::create_directory(reports / "a.html");
    EXPECT_TRUE(names().empty());
    EXPECT_EQ(files.read("notes.txt").error().status, 404);
}

TEST_F(Files, AReportGetsAnOriginOfItsOwn) {
    write(reports / "job.html", "<p>done");
    const auto response = files.read("job.html");
    ASSERT_TRUE(response);
    EXPECT_EQ(std::get<std::string>(response->body), "<p>done");
    EXPECT_TRUE(header(*response, "Content-Security-Policy").starts_with("sandbox"))
        << "it may run no code of the page's";
    EXPECT_EQ(header(*response, "Content-Security-Policy").find("allow-same-origin"), std::string::npos);
}

TEST_F(Files, AnIncidentIsDownloaded) {
    write(incidents / "a.html", "<script>");
    const auto response = files.read("a.html");
    ASSERT_TRUE(response);
    EXPECT_EQ(header(*response, "Content-Type"), "application/octet-stream");
    EXPECT_EQ(header(*response, "Content-Disposition"), "attachment");
}

TEST_F(Files, NoNameLeadsOutOfTheirDirectories) {
    write(directory.path() / "secret.html", "secret");
    std::filesystem::create_symlink(directory.path() / "secret.html", reports / "link.html");
    for (const char* name :
         {"../secret.html", "secret.html", "link.html", "", ".", "..", "job.html/../../secret.html"}) {
        EXPECT_EQ(files.read(name).error().code, "no-such-file") << name;
    }
}

TEST_F(Files, AreShownUpToABound) {
    for (std::size_t i = 0; i < ReportFiles::kMostFiles + 20; ++i) {
        write(reports / (std::to_string(i) + ".html"), "");
    }
    EXPECT_EQ(names().size(), ReportFiles::kMostFiles);
}

}  // namespace
}  // namespace lockstep::web
