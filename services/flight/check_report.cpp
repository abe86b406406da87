#include "services/flight/check_report.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <string>

#include "services/flight/flight_ring.hpp"
#include "services/runtime/log.hpp"

namespace lockstep {
namespace {

std::atomic<FlightLog*> flight_of_process = nullptr;

/// Returns the path within the source tree, such as "core/motion/profile.cpp", without the build directory.
std::string_view in_tree(std::string_view file) {
    for (const std::string_view folder : {"/core/", "/services/", "/sim_fpga/"}) {
        if (const auto at = file.rfind(folder); at != file.npos) { return file.substr(at + 1); }
    }
    return file;
}

void report(std::string_view promise, const std::source_location& where) {
    char text[kFlightNoteBytes];
    const std::string_view file = in_tree(where.file_name());
    const int length =
        std::snprintf(text, sizeof text, "failed check: %.*s (%.*s:%u)", static_cast<int>(promise.size()),
                      promise.data(), static_cast<int>(file.size()), file.data(), static_cast<unsigned>(where.line()));
    const std::string_view note(text, std::min(static_cast<std::size_t>(length), sizeof text - 1));
    if (FlightLog* const flight = flight_of_process.load()) { flight->set_note(note); }
    log_error(std::string(note) + "; this is a defect of Lockstep; please report it with the incident file");
}

}  // namespace

CheckReport::CheckReport(FlightLog& flight) : before_(set_check_reporter(report)) { flight_of_process = &flight; }

CheckReport::~CheckReport() {
    set_check_reporter(before_);
    flight_of_process = nullptr;
}

}  // namespace lockstep
