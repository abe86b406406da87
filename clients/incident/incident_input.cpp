#include "clients/incident/incident_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "services/files/access.hpp"
#include "services/flight/incident_file.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using incident::FlightFile;

struct Files {
    std::vector<FlightFile> read;
    std::vector<std::string> left_out;
};

std::expected<void, std::string> read_directory(const fs::path& directory, Files& files) {
    std::error_code error;
    const fs::directory_iterator readable(directory, error);
    if (error) { return std::unexpected(directory.string() + ": " + why_not_read(directory, error.value())); }
    const auto found = incident_files(directory);
    if (found.empty()) {
        return std::unexpected(directory.string() +
                               ": this directory has no incident file; lockstep status shows the machine's directory, "
                               "and lockstep flight writes incident files");
    }
    for (const fs::path& path : found) {
        auto file = incident::read_flight_file(path);
        file ? files.read.push_back(*std::move(file)) : files.left_out.push_back(file.error());
    }
    if (files.read.empty()) { return std::unexpected(files.left_out.front()); }
    return {};
}

std::expected<Files, std::string> read_all(const std::vector<fs::path>& named) {
    Files files;
    for (const fs::path& path : named) {
        std::error_code error;
        if (fs::is_directory(path, error)) {
            if (const auto read = read_directory(path, files); !read) { return std::unexpected(read.error()); }
            continue;
        }
        auto file = incident::read_flight_file(path);
        if (!file) { return std::unexpected(file.error()); }
        files.read.push_back(*std::move(file));
    }
    return files;
}

}  // namespace

std::expected<IncidentInput, std::string> read_incidents(const std::vector<fs::path>& named) {
    auto files = read_all(named);
    if (!files) { return std::unexpected(files.error()); }
    const auto machine_of = [](const FlightFile& file) { return file.head.source.machine; };
    const auto& first = files->read.front();
    const auto other = std::ranges::find_if(
        files->read, [&](const FlightFile& file) { return machine_of(file) != machine_of(first); });
    if (other != files->read.end()) {
        return std::unexpected(fmt::format(
            "files of the machines {} and {} are named together; name the files of one machine: {} is of {}",
            machine_of(first), machine_of(*other), first.path.string(), machine_of(first)));
    }
    return IncidentInput{incident::incidents_of(files->read), std::move(files->left_out)};
}

}  // namespace lockstep
