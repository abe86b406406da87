#include "clients/lockstep/offline/figure_files.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace lockstep {

std::expected<void, std::string> write_figures(const std::filesystem::path& directory,
                                               const std::vector<std::pair<std::string, drawing::Figure>>& figures) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error) { return std::unexpected(directory.string() + ": cannot be made: " + error.message()); }
    for (const auto& [name, figure] : figures) {
        const auto path = directory / name;
        errno = 0;
        std::ofstream out(path, std::ios::binary | std::ios::trunc);
        out << drawing::to_svg(figure);
        out.close();
        if (!out) { return std::unexpected(path.string() + ": cannot be written: " + std::strerror(errno)); }
    }
    return {};
}

}  // namespace lockstep
