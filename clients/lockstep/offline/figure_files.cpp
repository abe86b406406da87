#include "clients/lockstep/offline/figure_files.hpp"

#include <system_error>

#include "services/files/text_file.hpp"

namespace lockstep {

std::expected<void, std::string> write_figures(const std::filesystem::path& directory,
                                               const std::vector<std::pair<std::string, drawing::Figure>>& figures) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) { return std::unexpected(directory.string() + ": cannot be created: " + error.message()); }
    for (const auto& [name, figure] : figures) {
        if (auto done = write_text_file(directory / name, drawing::to_svg(figure)); !done) { return done; }
    }
    return {};
}

}  // namespace lockstep
